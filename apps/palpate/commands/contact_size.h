// `palpate contact --size`: diameter and compression of the held object, one row for each grasp.
#pragma once

#include "commands/command_line.h"

namespace palpate::commands {

// Returns the exit code; throws UsageError for options that cannot be combined with --size.
int contactSizes(const CommandLine& given);

}  // namespace palpate::commands

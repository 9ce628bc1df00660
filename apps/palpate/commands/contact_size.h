// palpate contact --size: diameter and compression of what is held, a row per grasp.
#pragma once

#include "commands/command_line.h"

namespace palpate::commands {

// Returns the exit code; throws UsageError for options that don't go with --size.
int contactSizes(const CommandLine& given);

}  // namespace palpate::commands

// What exports to other programs write in addition to the recording: options that leave series out,
// and the row with the units.
#pragma once

#include <filesystem>
#include <vector>

#include <palpate/batch/export_extras.h>

#include "commands/command_line.h"

namespace palpate::commands {

// --units-row of commands that print CSV.
OptionSpec unitsRowOption();
// `options` followed by --no-signals, --no-slip, --compression, --images and --units-row.
std::vector<OptionSpec> withExportOptions(std::vector<OptionSpec> options);

// What the options choose for a recording that is filtered by `filters` and saved as `out`. Throws
// UsageError (an option that `out` can't have), FileError (an unknown ending).
ExportChoices exportChoicesOf(const CommandLine& given,
                              const Recipe& filters,
                              const std::filesystem::path& out);

}  // namespace palpate::commands

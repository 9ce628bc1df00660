// What exports to other programs write beside the recording: where it comes from, and the series of
// signals and slip, which options leave out.
#pragma once

#include <filesystem>
#include <vector>

#include <palpate/filter/recipe.h>
#include <palpate/model/profile.h>
#include <palpate/recording/recording.h>

#include "commands/command_line.h"

namespace palpate::commands {

// `options` followed by --no-signals, --no-slip, --compression, --images and --units-row.
std::vector<OptionSpec> withExportOptions(std::vector<OptionSpec> options);

// What is saved beside `profile`, which was read from `in`, filtered by `recipe` (empty: not
// filtered) and is to be saved as `out`: what was said of the recording, and for .h5, .mat and
// .mcap the series and where all of it comes from (`in` is read for its hash). Throws UsageError
// (an option that `out` can't have), FileError, FormatError.
SaveExtras saveExtrasOf(const CommandLine& given,
                        const std::filesystem::path& in,
                        const std::filesystem::path& out,
                        const Profile& profile,
                        const Recipe& recipe);

}  // namespace palpate::commands

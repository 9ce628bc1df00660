// The options --filter and --recipe of every command that can filter a recording, and the option
// --signal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include <palpate/filter/recipe.h>
#include <palpate/model/time_base.h>
#include <palpate/recognition/filtered_recording.h>
#include <palpate/signals/characteristic_signals.h>

#include "commands/command_line.h"

namespace palpate::commands {

// The filter options, to be added to those of a command.
std::vector<OptionSpec> filterOptions();
// `options` followed by the filter options.
std::vector<OptionSpec> withFilterOptions(std::vector<OptionSpec> options);

// The signals of --signal.
std::vector<std::pair<std::string, SignalKind>> signalWords();

// --time, and what it chooses. Throws UsageError.
OptionSpec timeOption();
TimeChoice timeChoiceOf(const CommandLine& given);
// Takes the times that --time chooses (takeFittedTimes()), and reports on standard error what is
// known of the clocks, unless quiet.
void takeTimes(const CommandLine& given,
               Recording& recording,
               const std::filesystem::path& file,
               const Progress& progress = {});

// --from N and --to M.
std::vector<OptionSpec> withFrameOptions(std::vector<OptionSpec> options);
struct FrameChoice {
  std::optional<std::int64_t> from = {}, to = {};
};
FrameChoice frameChoiceOf(const CommandLine& given);  // throws UsageError
// First and last frame, both inclusive; {1, 0} of a recording without frames, where none is chosen.
// Throws Error when the recording doesn't have a frame that is chosen.
std::pair<std::size_t, std::size_t> framesOf(const FrameChoice& choice,
                                             const std::filesystem::path& file,
                                             const Profile& profile);

// The recipe that the options describe; empty when there are none. Throws UsageError for an invalid
// text and Error for an invalid file.
Recipe recipeOf(const CommandLine& given);

// The characteristic signal of --signal NAME; nothing when the option is missing. Throws UsageError
// that lists all names.
std::optional<SignalKind> signalChosen(const CommandLine& given);

// All filters with their options, as `palpate filter --list` prints them.
std::string filterList();

}  // namespace palpate::commands

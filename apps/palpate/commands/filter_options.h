// --filter and --recipe, for every command that can look at a recording through filters; --signal.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/filter/recipe.h>
#include <palpate/model/profile.h>
#include <palpate/signals/characteristic_signals.h>

#include "commands/command_line.h"

namespace palpate::commands {

// The options, to be put among a command's own.
std::vector<OptionSpec> filterOptions();
// `options` and the filter options behind them.
std::vector<OptionSpec> withFilterOptions(std::vector<OptionSpec> options);

// Empty where none is asked for. Throws UsageError (what a text says), Error (what a file says).
Recipe recipeOf(const CommandLine& given);
// The recording as it is where the recipe is empty. Events "settings" restart the filters over
// time. Throws Error (a matrix that the recording hasn't; a file that can't be read), Cancelled.
Profile filteredBy(const Recipe& recipe,
                   const Profile& profile,
                   const std::filesystem::path& file,
                   const Progress& progress = {});

// --signal NAME, a characteristic signal; nothing where it isn't given. Throws UsageError naming
// all.
std::optional<SignalKind> signalChosen(const CommandLine& given);

// All filters with their options, as `palpate filter --list` prints them.
std::string filterList();

}  // namespace palpate::commands

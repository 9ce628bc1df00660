// The subcommands of `palpate calibrate`: one function for each kind, which takes the words after
// it; and the options that they share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/calibration/step_fit.h"
#include "palpate/core/json.h"
#include "palpate/signals/characteristic_signals.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/table_command.h"

namespace palpate::commands {

int calibrateApply(const Arguments& words);
int calibrateNoise(const Arguments& words);
int calibratePressure(const Arguments& words);
int calibrateSensitivity(const Arguments& words);
int calibrateStep(const Arguments& words);
int calibrateTare(const Arguments& words);

std::vector<std::string> calibrationKinds();  // "noise", ..

// The matrix that --matrix names; throws UsageError when it is missing or negative.
std::size_t matrixGiven(const CommandLine& given);
// The option --matrix M of these commands.
OptionSpec matrixSpec();
// The common first members of the JSON of one kind: the kind, format version, program version, and
// time of creation.
Json provenance(const std::string& kind);

}  // namespace palpate::commands

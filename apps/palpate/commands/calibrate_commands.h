// palpate calibrate KIND ..: one function per kind, each given the words behind it.
#pragma once

#include <filesystem>
#include <string>

#include "palpate/calibration/step_fit.h"
#include "palpate/core/json.h"
#include "palpate/signals/characteristic_signals.h"

#include "commands/command_line.h"
#include "commands/commands.h"

namespace palpate::commands {

int calibrateApply(const Arguments& words);
int calibrateNoise(const Arguments& words);
int calibratePressure(const Arguments& words);
int calibrateSensitivity(const Arguments& words);
int calibrateStep(const Arguments& words);
int calibrateTare(const Arguments& words);

// The matrix that --matrix names; throws UsageError where it is missing or negative.
std::size_t matrixGiven(const CommandLine& given);
// --signal, by the names of `palpate signals`; the filtered mean where it isn't given.
SignalKind signalGiven(const CommandLine& given);
// Throws Error naming the file and what it has.
void requireMatrix(const std::filesystem::path& file, std::size_t numMatrices, std::size_t matrix);
// --loss squares|huber|cauchy.
StepLoss lossGiven(const CommandLine& given);
// Begins the JSON of one kind: what it is, format version, program version, when.
Json provenance(const std::string& kind);
// To standard output, or into the file of -o (unless that was written already).
void printJson(const CommandLine& given, const Json& json, bool outputWritten = false);

}  // namespace palpate::commands

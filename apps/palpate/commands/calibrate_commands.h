// palpate calibrate KIND ..: one function per kind, each given the words behind it.
#pragma once

#include <filesystem>
#include <string>

#include "palpate/core/json.h"
#include "palpate/filter/characteristic_signals.h"

#include "commands/command_line.h"
#include "commands/commands.h"

namespace palpate::commands {

int calibrateStep(const Words& words);

// The matrix that --matrix names; throws UsageError where it is missing or negative.
std::size_t matrixGiven(const CommandLine& given);
// --signal, by the names of `palpate signals`; the filtered mean where it isn't given.
SignalKind signalGiven(const CommandLine& given);
// Throws Error naming the file and what it has.
void requireMatrix(const std::filesystem::path& file, std::size_t numMatrices, std::size_t matrix);
// To standard output, or into the file of -o.
void printJson(const CommandLine& given, const Json& json);

}  // namespace palpate::commands

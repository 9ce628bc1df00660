// Commands whose result is a table of each recording: all of them as one table on standard output,
// as CSV or JSON, or a file for each.
#pragma once

#include <string>
#include <vector>

#include <palpate/batch/batch_plan.h>
#include <palpate/batch/batch_task.h>

#include "commands/command_line.h"

namespace palpate::commands {

// `options` followed by --units-row, --json and those of batch_options.h.
std::vector<OptionSpec> withTableOptions(std::vector<OptionSpec> options);

// What the options choose, for RecordingTable::options: those that the rows depend on.
std::string choicesText(const CommandLine& given);

// How the options want a table as text. Throws UsageError.
TableTextOptions tableTextOf(const CommandLine& given);
// The template that -o gives, whose ending (.csv, .json) says the form. Throws UsageError, also for
// --json and --units-row that don't fit it.
BatchTemplate tableTemplateOf(const CommandLine& given);
// Writes one table to standard output.
void writeTable(const CommandLine& given, ResultTable& table);

// Runs a command that makes a table of each recording. Returns the exit code. Throws UsageError.
int runTableCommand(const CommandLine& given, const RecordingTable& table);

}  // namespace palpate::commands

// The options of commands that write a file for each of many recordings (-o TEMPLATE), and the run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <palpate/batch/batch_run.h>

#include "commands/command_line.h"

namespace palpate::commands {

// `options` followed by --output, --force, --resume, --threads and --report.
std::vector<OptionSpec> withBatchOptions(std::vector<OptionSpec> options);
// `options` followed by the last three only.
std::vector<OptionSpec> withResumeOptions(std::vector<OptionSpec> options);
// Whether one of --resume, --threads and --report is given.
bool hasBatchOptions(const CommandLine& given);
// Throws UsageError when one of them is given: it needs -o.
void refuseBatchOptions(const CommandLine& given);

// The template of -o, whose ending must be one of `endings` (empty: any). Throws UsageError.
BatchTemplate batchTemplateOf(const CommandLine& given, const std::vector<std::string>& endings);

struct BatchCommand {
  // What is read; empty: the words of the command.
  std::vector<std::filesystem::path> paths = {};
  SameResults sameResults = SameResults::kRefuse;
  // Whether a table of what was done and failed ends the output.
  bool summary = true;
};
// Runs the task; returns the exit code: 0 all done or skipped, 1 none, 3 some, also after an
// interruption. Throws UsageError, Error before anything is computed.
int runBatchCommand(const CommandLine& given,
                    const BatchTemplate& names,
                    const BatchTask& task,
                    const BatchCommand& command = {});

}  // namespace palpate::commands

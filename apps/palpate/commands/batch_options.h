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
// Whether one of --resume, --threads and --report is given.
bool hasBatchOptions(const CommandLine& given);
// Throws UsageError when one of them is given: it needs -o.
void refuseBatchOptions(const CommandLine& given);

// Runs the task over the words of the command, or over `folder` if it is given with the template
// `names`; returns the exit code: 0 all done or skipped, 1 none, 3 some, also after an
// interruption. The ending of the template must be one of `endings` (empty: any). Throws
// UsageError, Error before anything is computed.
int runBatchCommand(const CommandLine& given,
                    const std::vector<std::string>& endings,
                    const BatchTask& task,
                    const std::filesystem::path& folder = {},
                    const std::filesystem::path& names = {});

}  // namespace palpate::commands

// Commands whose result is a table: of each recording (all of them as one table on standard output,
// or a file for each), or one table; as CSV or JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <palpate/batch/batch_plan.h>
#include <palpate/batch/batch_task.h>
#include <palpate/core/json.h>
#include <palpate/core/output_file.h>

#include "commands/command_line.h"

namespace palpate::commands {

// `options` followed by --units-row, --json and those of batch_options.h.
std::vector<OptionSpec> withTableOptions(std::vector<OptionSpec> options);
// `options` followed by -o FILE and --force: of a command with one result. CommandLine then throws
// FileError, before the work, for a file that the command reads, and for one that exists where
// --force is missing.
std::vector<OptionSpec> withOutputOptions(
    std::vector<OptionSpec> options,
    const std::string& file = "OUT.json",
    const std::string& help = "write the result to this file");
// The same with --units-row and --json, which CommandLine checks with -o as tableTextOf(): of a
// command with one table.
std::vector<OptionSpec> withOneTableOptions(
    std::vector<OptionSpec> options, const std::string& json = "one object of JSON instead of CSV");

// --time-column s|utc, which runTableCommand() obeys.
OptionSpec timeColumnOption();
// `table` of a recording with the column that it chooses. Throws UsageError.
std::unique_ptr<ResultTable> withTimeColumn(const CommandLine& given,
                                            const std::filesystem::path& file,
                                            const Recording& recording,
                                            std::unique_ptr<ResultTable> table);

// What the options choose, for RecordingTable::options: those that the rows depend on.
std::string choicesText(const CommandLine& given);

// JSON by the ending of -o, without it by --json. Throws UsageError for another ending than .csv
// and .json, and for a template.
TableForm formOf(const CommandLine& given);
// How the options want a table as text. Throws UsageError.
TableTextOptions tableTextOf(const CommandLine& given);
// The template that -o gives, whose ending chooses the form. Throws UsageError, also for --json and
// --units-row that don't fit it.
BatchTemplate tableTemplateOf(const CommandLine& given);

// Where the one result of a command goes: standard output, or the file of -o, which finish()
// names on standard output.
class ResultOutput {
 public:
  ResultOutput() = default;  // standard output
  // Throws FileError, also when the file exists and --force is missing. `outputTaken`: -o is
  // something else, the result goes to standard output.
  explicit ResultOutput(const CommandLine& given, bool outputTaken = false);
  void write(const std::string& text);  // throws OutputError
  void flush();                         // what is for standard output
  void finish();                        // without it there is no file

 private:
  bool quiet_ = false;
  StandardOutput out_;
  std::optional<OutputFile> file_;
};
// The rows of a table as a list of objects.
Json rowsJson(ResultTable& table);
// An object as the whole result.
void printJson(const CommandLine& given, const Json& json, bool outputTaken = false);

// Writes the rows of tables with the same columns as one table.
class TableOutput {
 public:
  explicit TableOutput(const CommandLine& given);  // throws UsageError, FileError
  void add(ResultTable& table);
  void finish();

 private:
  const TableTextOptions text_;
  ResultOutput out_;
  bool begun_ = false, hasRows_ = false;
};
// Writes one table, then its notes (unless quiet) and problems to standard error. Returns
// kPartlyDone after a problem.
[[nodiscard]] int writeTable(const CommandLine& given, ResultTable& table);

// Runs a command that makes a table of each recording. Returns the exit code. Throws UsageError.
int runTableCommand(const CommandLine& given, const RecordingTable& table);

}  // namespace palpate::commands

#include "commands/table_command.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include "palpate/core/escaped_line.h"
#include "palpate/core/file_name.h"
#include "palpate/model/time_base.h"
#include "palpate/model/time_columns.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/result_file.h"

#include "commands/batch_options.h"
#include "commands/commands.h"
#include "commands/export_options.h"
#include "commands/filter_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

constexpr const char* kOptionsOfTheRun[] = {
    "output", "force", "resume", "threads", "report", "quiet", "json", "units-row"};
constexpr const char* kUnitsOfJson =
    "--units-row is a row of CSV; JSON has the units of its columns";

Overwrite overwriteOf(const CommandLine& given) {
  return given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse;
}

// The value of another option can also be a file: a model, a calibration.
void checkOutput(const CommandLine& given) {
  const auto out = given.text("output");
  if (!out) return;
  for (const std::string& word : given.words()) requireOther(word, *out);
  for (const auto& [name, values] : given.options())
    if (name != "output")
      for (const std::string& value : values) requireOther(value, *out);
  requireWritable(*out, overwriteOf(given));
}

}  // namespace

std::vector<OptionSpec> withTableOptions(std::vector<OptionSpec> options) {
  options.push_back(unitsRowOption());
  options.push_back({"json", "", "one object of JSON instead of CSV; -o: by the ending"});
  return withBatchOptions(std::move(options));
}

std::vector<OptionSpec> withOutputOptions(std::vector<OptionSpec> options,
                                          const std::string& file,
                                          const std::string& help) {
  options.push_back({"output,o", file, help, &checkOutput});
  options.push_back({"force", "", "replace a file that exists"});
  return options;
}

std::vector<OptionSpec> withOneTableOptions(std::vector<OptionSpec> options,
                                            const std::string& json) {
  options.push_back(unitsRowOption());
  options.push_back({"json", "", json + "; -o: by the ending", &tableTextOf});
  return withOutputOptions(std::move(options), "OUT.csv");
}

OptionSpec timeColumnOption() {
  return {"time-column",
          "s|utc",
          "add a column next to time_ms; s: seconds from the first frame; utc: date"};
}

std::unique_ptr<ResultTable> withTimeColumn(const CommandLine& given,
                                            const std::filesystem::path& file,
                                            const Recording& recording,
                                            std::unique_ptr<ResultTable> table) {
  const auto which = given.choice("time-column", {"s", "utc"});
  if (!which) return table;
  try {
    return withTimeColumns(std::move(table),
                           atTimes(timeChoiceOf(given), recording.profile, file),
                           *which == "s" ? TimeColumn::kSeconds : TimeColumn::kUtc);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--time-column: ") + error.what());
  }
}

std::string choicesText(const CommandLine& given) {
  std::string text;
  for (const auto& [name, values] : given.options()) {
    const auto is = [&name](const char* other) { return name == other; };
    if (std::any_of(std::begin(kOptionsOfTheRun), std::end(kOptionsOfTheRun), is)) continue;
    text += "; " + name;
    for (const std::string& value : values) text += " " + value;
  }
  return text;
}

TableForm formOf(const CommandLine& given) {
  const auto out = given.text("output");
  if (!out) return given.has("json") ? TableForm::kJson : TableForm::kCsv;
  if (out->find_first_of("{}") != std::string::npos)
    throw UsageError("-o '" + *out + "': this is one table: give the name of a file");
  const std::string ending = lowerEndingOf(*out);
  if (ending != ".csv" && ending != ".json")
    throw UsageError("-o '" + *out + "' must end in .csv, .json");
  return tableFormOf(*out);
}

TableTextOptions tableTextOf(const CommandLine& given) {
  const TableForm form = formOf(given);
  const bool unitsRow = given.has("units-row");
  if (form == TableForm::kJson && unitsRow) throw UsageError(kUnitsOfJson);
  return {.form = form, .unitsRow = unitsRow};
}

BatchTemplate tableTemplateOf(const CommandLine& given) {
  BatchTemplate names = batchTemplateOf(given, resultEndings());
  const std::string ending = lowerEndingOf("x" + names.ending());
  if (given.has("json") && ending != ".json")
    throw UsageError("--json with -o: let the template end in .json");
  if (given.has("units-row") && ending != ".csv")
    throw UsageError("--units-row is for .csv; other forms have the units with their columns");
  return names;
}

ResultOutput::ResultOutput(const CommandLine& given, bool outputTaken) : quiet_(given.quiet()) {
  if (const auto out = given.text("output"); out && !outputTaken)
    file_.emplace(*out, overwriteOf(given));
}

void ResultOutput::write(const std::string& text) {
  if (!file_) return out_.write(text);
  try {
    file_->write(text);
  } catch (const FileError& error) {
    throw OutputError(error.what());
  }
}

void ResultOutput::flush() { out_.finish(); }

void ResultOutput::finish() {
  if (file_) {
    file_->commit();
    if (!quiet_) out_.write(escapedLine(file_->path().string()) + "\n");
  }
  out_.finish();
}

Json rowsJson(ResultTable& table) {
  const auto valueOf = [](const auto& value) -> Json {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, std::monostate>)
      return {};
    else
      return value;
  };
  Json rows = Json::array();
  for (std::vector<Cell> cells; table.next(cells);) {
    Json row = Json::object();
    for (std::size_t i = 0; i < cells.size(); ++i)
      row.set(table.columns()[i].name, std::visit(valueOf, cells[i]));
    rows.push(std::move(row));
  }
  return rows;
}

void printJson(const CommandLine& given, const Json& json, bool outputTaken) {
  ResultOutput out(given, outputTaken);
  out.write(json.text() + "\n");
  out.finish();
}

TableOutput::TableOutput(const CommandLine& given) : text_(tableTextOf(given)), out_(given) {}

void TableOutput::add(ResultTable& table) {
  constexpr std::size_t kPiece = 1u << 16;
  const TableText form(table, text_);
  std::string text;
  if (!std::exchange(begun_, true)) text = form.begin();
  for (std::vector<Cell> cells; table.next(cells);) {
    const std::size_t from = text.size();
    form.appendRow(text, cells);
    // The first row of all has no comma in front of it.
    if (!std::exchange(hasRows_, true) && text_.form == TableForm::kJson) text.erase(from, 1);
    if (text.size() < kPiece) continue;
    out_.write(text);
    text.clear();
  }
  out_.write(text);
  out_.flush();
}

void TableOutput::finish() {
  if (begun_ && text_.form == TableForm::kJson) out_.write(kJsonTableEnd);
  out_.finish();
}

int writeTable(const CommandLine& given, ResultTable& table) {
  TableOutput out(given);
  out.add(table);
  out.finish();
  if (!given.quiet())
    for (const std::string& note : table.notes()) sayLine(note);
  const std::vector<std::string> problems = table.problems();
  for (const std::string& problem : problems) sayLine(problem);
  return problems.empty() ? kDone : kPartlyDone;
}

int runTableCommand(const CommandLine& given, const RecordingTable& table) {
  RecordingTable chosen = table;
  chosen.unitsRow = given.has("units-row");
  if (const auto which = given.choice("time-column", {"s", "utc"})) {
    chosen.options += "; time-column " + *which;
    chosen.of = [&given, of = table.of](
                    const auto& file, const auto& recording, const auto& shown) {
      return withTimeColumn(given, file, recording, of(file, recording, shown));
    };
  }
  if (given.has("output")) return runBatchCommand(given, tableTemplateOf(given), tableTask(chosen));
  refuseBatchOptions(given);
  return writeTables(recordingsIn(given.words()),
                     given.quiet(),
                     {.of = chosen.of, .text = tableTextOf(given), .readable = table.readable});
}

}  // namespace palpate::commands

#include "commands/table_command.h"

#include <algorithm>
#include <iterator>

#include "commands/batch_options.h"
#include "commands/export_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

constexpr const char* kOptionsOfTheRun[] = {
    "output", "force", "resume", "threads", "report", "quiet", "json", "units-row"};
constexpr const char* kUnitsOfJson =
    "--units-row is a row of CSV; JSON has the units of its columns";

}  // namespace

std::vector<OptionSpec> withTableOptions(std::vector<OptionSpec> options) {
  options.push_back(unitsRowOption());
  options.push_back({"json", "", "one object of JSON instead of CSV; -o: by the ending"});
  return withBatchOptions(std::move(options));
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

TableTextOptions tableTextOf(const CommandLine& given) {
  const bool asJson = given.has("json"), unitsRow = given.has("units-row");
  if (asJson && unitsRow) throw UsageError(kUnitsOfJson);
  return {.form = asJson ? TableForm::kJson : TableForm::kCsv, .unitsRow = unitsRow};
}

BatchTemplate tableTemplateOf(const CommandLine& given) {
  BatchTemplate names = batchTemplateOf(given, {".csv", ".json"});
  const bool isJson = tableFormOf("x" + names.ending()) == TableForm::kJson;
  if (given.has("json") && !isJson)
    throw UsageError("--json with -o: let the template end in .json");
  if (given.has("units-row") && isJson) throw UsageError(kUnitsOfJson);
  return names;
}

void writeTable(const CommandLine& given, ResultTable& table) {
  StandardOutput out;
  writeTableText(table, tableTextOf(given), [&](const std::string& text) { out.write(text); });
  out.finish();
}

int runTableCommand(const CommandLine& given, const RecordingTable& table) {
  RecordingTable chosen = table;
  chosen.unitsRow = given.has("units-row");
  if (given.has("output")) return runBatchCommand(given, tableTemplateOf(given), tableTask(chosen));
  refuseBatchOptions(given);
  return writeTables(recordingsIn(given.words()),
                     given.quiet(),
                     {.of = table.of, .text = tableTextOf(given), .readable = table.readable});
}

}  // namespace palpate::commands

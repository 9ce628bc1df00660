// writeMcapTable() of result_writers.h.
#include <optional>

#include "palpate/core/error.h"
#include "palpate/core/time.h"

#include "recording/mcap/mcap_file_writer.h"
#include "recording/mcap/mcap_format.h"
#include "recording/result_writers.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

// Where the time of a row stands.
struct TimeCell {
  std::size_t column = 0;
  std::int64_t unitUs = 1;
};
std::optional<TimeCell> timeCellOf(const std::vector<ResultColumn>& columns) {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string& name = columns[c].name;
    if (columns[c].kind != CellKind::kInteger) continue;
    if (name == "time_us") return TimeCell{c, 1};
    if (name == "time_ms" || name == "begin_ms") return TimeCell{c, kUsPerMs};
  }
  return std::nullopt;
}

const char* jsonTypeOf(CellKind kind) {
  switch (kind) {
    case CellKind::kInteger:
      return "integer";
    case CellKind::kNumber:
      return "number";
    case CellKind::kFlag:
      return "boolean";
    case CellKind::kText:
      break;
  }
  return "string";
}

// JSON Schema of a row. Any cell may be null: not known.
std::string rowSchema(const ResultTable& table) {
  Json properties = Json::object();
  for (const ResultColumn& each : table.columns())
    properties.set(
        each.name,
        Json::object()
            .set("type", jsonTypeOf(each.kind))
            .set("description", each.meaning + (each.unit.empty() ? "" : " [" + each.unit + "]")));
  return Json::object()
      .set("title", table.name())
      .set("type", "object")
      .set("properties", std::move(properties))
      .text(-1);
}

}  // namespace

std::size_t writeMcapTable(ResultTable& table,
                           const fs::path& path,
                           Overwrite overwrite,
                           const McapWriteOptions& options) {
  const std::optional<TimeCell> time = timeCellOf(table.columns());
  if (!time)
    throw FileError(path,
                    "can't hold the table '" + table.name() +
                        "': it has no column time_us, time_ms or begin_ms; write .h5 or .csv");
  OutputFile out(path, overwrite);
  McapFileWriter file([&out](std::string_view bytes) { out.write(bytes); }, "", "palpate", options);
  const std::uint16_t schema =
      file.addSchema("palpate." + table.name(), "jsonschema", rowSchema(table));
  const std::uint16_t channel =
      file.addChannel(schema,
                      "/palpate/" + table.name(),
                      "json",
                      {{"columns", headOf(table).at("columns").text(-1)}});
  const TableText form(table, {.form = TableForm::kJson});
  std::string row;
  std::size_t count = 0;
  for (std::vector<Cell> cells; table.next(cells); ++count) {
    const auto* at = std::get_if<std::int64_t>(&cells[time->column]);
    if (!at) throw FileError(path, "row " + std::to_string(count) + " has no time");
    row.clear();
    form.appendRow(row, cells);
    std::string& message = file.beginMessage(channel, mcap_format::timeNs(*at * time->unitUs));
    message.append(row, row.find('{'));
    file.endMessage();
    file.endGroup();
  }
  file.finish();
  out.commit();
  return count;
}

}  // namespace palpate

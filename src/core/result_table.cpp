#include "palpate/core/result_table.h"

#include <cmath>
#include <limits>

#include "palpate/core/file_name.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/text_table.h"

namespace palpate {
namespace {

constexpr std::size_t kTableBytes = 1u << 16;

void appendNumberCell(std::string& text, double value, int decimals) {
  if (decimals < 0)
    appendNumber(text, value);
  else
    text += fixedText(value, decimals);
}

std::string csvText(const std::string& cell) {
  std::string line = csvLine({cell});
  line.pop_back();
  return line;
}

void appendCsvCell(std::string& text, const Cell& cell, const ResultColumn& column) {
  if (const auto* whole = std::get_if<std::int64_t>(&cell))
    appendNumber(text, *whole);
  else if (const auto* number = std::get_if<double>(&cell))
    appendNumberCell(text, *number, column.decimals);
  else if (const auto* flag = std::get_if<bool>(&cell))
    text += *flag ? '1' : '0';
  else if (const auto* words = std::get_if<std::string>(&cell))
    text += csvText(*words);
}

void appendJsonCell(std::string& text, const Cell& cell, const ResultColumn& column) {
  if (const auto* whole = std::get_if<std::int64_t>(&cell))
    appendNumber(text, *whole);
  else if (const auto* number = std::get_if<double>(&cell); number && std::isfinite(*number))
    appendNumberCell(text, *number, column.decimals);
  else if (const auto* flag = std::get_if<bool>(&cell))
    text += *flag ? "true" : "false";
  else if (const auto* words = std::get_if<std::string>(&cell))
    text += Json(*words).text(-1);
  else
    text += "null";
}

}  // namespace

const char* nameOf(CellKind kind) noexcept {
  switch (kind) {
    case CellKind::kInteger:
      return "integer";
    case CellKind::kNumber:
      return "number";
    case CellKind::kFlag:
      return "flag";
    case CellKind::kText:
      break;
  }
  return "text";
}

double numberOf(const Cell& cell) {
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  if (const auto* flag = std::get_if<bool>(&cell)) return *flag ? 1.0 : 0.0;
  return std::numeric_limits<double>::quiet_NaN();
}

ResultTable::ResultTable(std::string name, std::vector<ResultColumn> columns)
    : name_(std::move(name)), columns_(std::move(columns)) {}

TableText::TableText(const ResultTable& table, TableTextOptions options, const std::string& added)
    : name_(table.name()), columns_(table.columns()), options_(std::move(options)) {
  const bool isJson = options_.form == TableForm::kJson;
  for (const ResultColumn& each : columns_) {
    const bool isFirst = beforeCells_.empty();
    beforeCells_.push_back(isJson ? (isFirst ? "" : ", ") + Json(each.name).text(-1) + ": "
                                  : std::string(isFirst ? "" : ","));
  }
  if (!options_.addedName.empty()) {
    columns_.push_back({options_.addedName, CellKind::kText});
    afterRow_ = isJson ? ", " + Json(options_.addedName).text(-1) + ": " + Json(added).text(-1)
                       : "," + csvText(added);
  }
  afterRow_ += isJson ? "}" : "\n";
}

std::string TableText::begin() const {
  if (options_.form == TableForm::kJson) {
    const Json columns = jsonList(columns_, [](const ResultColumn& each) {
      return Json::object()
          .set("name", each.name)
          .set("unit", each.unit)
          .set("kind", nameOf(each.kind));
    });
    return "{\n\"table\": " + Json(name_).text(-1) + ",\n\"columns\": " + columns.text(-1) +
           ",\n\"rows\": [";
  }
  std::vector<std::string> names, units;
  for (const ResultColumn& each : columns_) {
    names.push_back(each.name);
    units.push_back(each.unit);
  }
  return csvLine(names) + (options_.unitsRow ? csvLine(units) : "");
}

void TableText::appendRow(std::string& text, const std::vector<Cell>& cells) const {
  const bool isJson = options_.form == TableForm::kJson;
  if (isJson) text += ",\n{";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    text += beforeCells_[i];
    if (isJson)
      appendJsonCell(text, cells[i], columns_[i]);
    else
      appendCsvCell(text, cells[i], columns_[i]);
  }
  text += afterRow_;
}

std::size_t writeTableText(ResultTable& table,
                           const TableTextOptions& options,
                           const std::function<void(const std::string& text)>& sink) {
  const TableText form(table, options);
  std::string text = form.begin();
  std::size_t count = 0;
  for (std::vector<Cell> cells; table.next(cells); ++count) {
    const std::size_t begin = text.size();
    form.appendRow(text, cells);
    if (count == 0 && options.form == TableForm::kJson) text.erase(begin, 1);
    if (text.size() < kTableBytes) continue;
    sink(text);
    text.clear();
  }
  sink(options.form == TableForm::kJson ? text + kJsonTableEnd : text);
  return count;
}

std::size_t writeTableFile(ResultTable& table,
                           const std::filesystem::path& path,
                           Overwrite overwrite,
                           const TableTextOptions& options) {
  OutputFile file(path, overwrite);
  const std::size_t rows =
      writeTableText(table, options, [&](const std::string& text) { file.write(text); });
  file.commit();
  return rows;
}

TableForm tableFormOf(const std::filesystem::path& path) {
  return lowerEndingOf(path.string()) == ".json" ? TableForm::kJson : TableForm::kCsv;
}

}  // namespace palpate

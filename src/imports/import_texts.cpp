#include "imports/import_texts.h"

#include <algorithm>
#include <set>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "imports/column_unit.h"
#include "imports/column_words.h"

namespace palpate {
namespace {

// What the cells of a column hold instead of numbers: "text such as "0x1F": hexadecimal".
std::string whyNoNumbers(const TableColumn& column) {
  if (column.example.empty())
    return column.type == "structure" ? "structure: save each field as a separate array"
                                      : column.type;
  const std::string_view cell = column.example;
  const std::string text = column.type + " such as " + inQuotes(cell);
  if (cell.starts_with("0x") || cell.starts_with("0X")) return text + ": hexadecimal";
  if (cell.starts_with("\xE2\x88\x92")) return text + ": its minus is not an ASCII minus";
  const auto blank = cell.find_first_not_of("+-.0123456789");
  if (blank != 0 && blank != std::string_view::npos && isKnownUnit(cell.substr(blank)))
    return text + ": a unit in the cell; put it into the name";
  return text;
}

}  // namespace

std::string sentenceOf(Reason reason, std::initializer_list<std::string> values) {
  std::string text;
  for (std::size_t i = 0; i < reason.sentence.size(); ++i) {
    const char mark = reason.sentence[i];
    if (mark != '%' && mark != '$' && mark != '~') {
      text += mark;
      continue;
    }
    const std::string& value = values.begin()[reason.sentence[++i] - '1'];
    text += mark == '%' ? value : mark == '$' ? inQuotes(value) : shortened(value);
  }
  return text;
}

std::string samplesText(PlannedSeries::Kind kind) {
  return kind == PlannedSeries::Kind::kAngles ? "joint angles" : "temperatures";
}

std::string matrixShape(const MatrixLayout& matrix) {
  return std::to_string(matrix.rows) + " x " + std::to_string(matrix.columns) +
         (matrix.touch.components == 3 ? " x 3" : "");
}

std::string shapeText(const SensorLayout& layout) {
  std::string text = layout.numMatrices() == 1
                         ? "1 matrix of "
                         : std::to_string(layout.numMatrices()) + " matrices of ";
  std::vector<std::string> shapes;
  for (const MatrixLayout& matrix : layout.matrices())
    if (std::find(shapes.begin(), shapes.end(), matrixShape(matrix)) == shapes.end())
      shapes.push_back(matrixShape(matrix));
  for (std::size_t i = 0; i < shapes.size(); ++i) text += (i > 0 ? " and " : "") + shapes[i];
  text += ", " + counted(layout.numCells(), "place");
  if (layout.numTaxels() != layout.numCells())
    text += " with " + counted(layout.numTaxels(), "taxel");
  if (layout.numReadings() != layout.numCells())
    text += ", " + counted(layout.numReadings(), "number");
  return text;
}

std::string valuesText(const std::vector<TableColumn>& columns,
                       const std::string& what,
                       const std::vector<TableElement>& elements,
                       const PlannedValue& value,
                       const std::string& unit) {
  const TableColumn& first = columns[elements.front().column];
  std::set<std::size_t> used;
  for (const TableElement& each : elements) used.insert(each.column);
  std::string text = what + ": " + shortened(first.name);
  if (used.size() > 1)
    text += " to " + shortened(columns[elements.back().column].name) + " (" +
            counted(used.size(), "column") + ")";
  else
    for (const std::size_t size : first.shape) text += " x " + std::to_string(size);
  if (value.scale != 1.0) text += ", x " + numberText(value.scale);
  if (value.offset != 0.0) text += ", + " + numberText(value.offset);
  if (!unit.empty()) text += " [" + unit + "]";
  return text;
}

std::string namesText(const std::vector<TableColumn>& columns) {
  constexpr std::size_t kShown = 12;
  std::string text;
  for (std::size_t c = 0; c < std::min(kShown, columns.size()); ++c) {
    text += (c > 0 ? ", " : "") + shortened(columns[c].name);
    for (const std::size_t size : columns[c].shape) text += "[" + std::to_string(size) + "]";
  }
  if (columns.size() > kShown) text += " and " + std::to_string(columns.size() - kShown) + " more";
  return text;
}

std::string unusableText(const std::vector<TableColumn>& columns) {
  constexpr std::size_t kShown = 6;
  std::string text;
  std::size_t count = 0;
  for (const TableColumn& column : columns) {
    if (holdsNumbers(column) || column.hasDates) continue;
    if (++count > kShown) continue;
    text += (count > 1 ? ", " : "; no numbers: ") + shortened(column.name) + " (" +
            whyNoNumbers(column) + ")";
  }
  if (count > kShown) text += " and " + std::to_string(count - kShown) + " more";
  std::set<std::string_view> names;
  for (const TableColumn& column : columns)
    if (!names.insert(column.name).second)
      return text + "; the name " + inQuotes(column.name) + " is there twice";
  return text;
}

std::string formsText(const std::vector<TableColumn>& columns, const SensorLayout& layout) {
  std::size_t numNumbers = 0;
  bool areArrays = false;
  for (const TableColumn& column : columns) {
    if (column.isNumeric && column.width() <= kMaxNumbersPerRow) numNumbers += column.width();
    areArrays = areArrays || !isScalar(column);
  }
  const std::string chosen =
      numNumbers >= layout.numTaxels() ? "; choose the columns of each matrix (--matrix)" : "";
  if (areArrays)
    return chosen +
           "; arrays are read as frames x rows x columns, frames x matrices x rows x "
           "columns, or frames x taxels";
  if (!chosen.empty()) return chosen;
  return "; texts are read with a number per taxel and a frame per line, or with a line for each "
         "row of the matrices; a line per taxel is read only as palpate convert writes it "
         "(frame, time_ms, matrix, y, x, value)";
}

}  // namespace palpate

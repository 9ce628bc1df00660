#include "imports/csv_shape.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/imports/import_time.h"

#include "imports/cell_text.h"
#include "imports/column_unit.h"

namespace palpate {
namespace {

using Cells = std::vector<std::string_view>;

constexpr std::string_view kRowNames = "row names";

// What a cell is, as far as the shape of the table depends on it.
enum class CellKind { kEmpty, kNumber, kDecimalComma, kDate, kText };

CellKind kindOf(std::string_view cell, char decimal) {
  double value = 0.0;
  switch (cellStateOf(cell, decimal, value)) {
    case CellState::kEmpty:
      return CellKind::kEmpty;
    case CellState::kNumber:
    case CellState::kNotFinite:
      return CellKind::kNumber;
    case CellState::kText:
      break;
  }
  if (isDateText(trimmedCell(cell))) return CellKind::kDate;
  return decimal == '.' && cellNumber(cell, ',') ? CellKind::kDecimalComma : CellKind::kText;
}

// The lines of the sample as cells, by one delimiter.
struct Candidate {
  char delimiter = ',';
  std::vector<Cells> rows;
  std::size_t numCells = 0;  // of most rows
  std::size_t numSuch = 0;   // rows with so many cells
  double numericFraction = 0.0;

  double score() const {
    return static_cast<double>(numSuch) / static_cast<double>(rows.size()) * numericFraction;
  }
};

// The lines of a sample, and the times before them that a serial monitor wrote; none: empty.
struct SampleLines {
  std::vector<std::string_view> texts;
  std::vector<std::string_view> stamps;
};

Candidate candidateOf(const SampleLines& lines, char delimiter, char decimal) {
  Candidate made;
  made.delimiter = delimiter;
  std::map<std::size_t, std::size_t> counts;         // of the rows with a number
  std::map<std::size_t, std::size_t> countsOfTexts;  // of the others
  for (std::size_t i = 0; i < lines.texts.size(); ++i) {
    Cells& row = made.rows.emplace_back();
    splitCells(lines.texts[i], delimiter, row);
    if (!lines.stamps.empty()) row.insert(row.begin(), lines.stamps[i]);
    const bool hasNumber = std::any_of(row.begin(), row.end(), [&](std::string_view cell) {
      const CellKind kind = kindOf(cell, decimal);
      return kind == CellKind::kNumber || kind == CellKind::kDecimalComma;
    });
    ++(hasNumber ? counts : countsOfTexts)[row.size()];
  }
  for (const auto& [numCells, rows] : counts.empty() ? countsOfTexts : counts)
    if (rows > made.numSuch || (rows == made.numSuch && numCells > made.numCells)) {
      made.numCells = numCells;
      made.numSuch = rows;
    }
  if (!counts.empty()) made.numSuch += countsOfTexts[made.numCells];
  std::size_t numeric = 0;
  std::size_t all = 0;
  for (const Cells& row : made.rows) {
    if (row.size() != made.numCells) continue;
    for (const std::string_view cell : row) {
      numeric += kindOf(cell, decimal) == CellKind::kText ? 0 : 1;
      ++all;
    }
  }
  made.numericFraction = all == 0 ? 0.0 : static_cast<double>(numeric) / static_cast<double>(all);
  return made;
}

Candidate bestCandidate(const SampleLines& lines, const TableOptions& options) {
  constexpr std::array kDelimiters = {',', ';', '\t', ' '};
  const bool areQuoted =
      std::any_of(lines.texts.begin(), lines.texts.end(), [](std::string_view line) {
        return line.find('"') != std::string_view::npos;
      });
  std::optional<Candidate> best;
  for (const char delimiter : kDelimiters) {
    if (options.delimiter != 0 && delimiter != options.delimiter) continue;
    // Decimal commas between commas need quotes.
    if (options.delimiter == 0 && delimiter == options.decimal && !areQuoted) continue;
    Candidate next = candidateOf(lines, delimiter, options.decimal);
    // A table of one column has no delimiter: any other candidate is better.
    const auto rank = [](const Candidate& each) {
      return std::pair(each.numCells > 1 ? each.score() : each.score() * 0.5, each.numCells);
    };
    if (!best || rank(next) > rank(*best)) best = std::move(next);
  }
  return std::move(*best);
}

bool isText(CellKind kind) { return kind == CellKind::kText; }
bool isValue(CellKind kind) {
  return kind == CellKind::kNumber || kind == CellKind::kDecimalComma || kind == CellKind::kDate;
}

// Which rows of the sample have the number of cells of the table, and what their cells are.
struct SampleRow {
  std::size_t index = 0;  // in the sample
  std::vector<CellKind> kinds;
};

std::vector<SampleRow> fullRows(const Candidate& table, char decimal) {
  std::vector<SampleRow> rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Cells& cells = table.rows[i];
    // The header may have one trailing empty cell fewer than the rows, or vice versa.
    const bool fits = cells.size() == table.numCells || cells.size() + 1 == table.numCells;
    if (!fits) continue;
    SampleRow row{i, {}};
    for (const std::string_view cell : cells) row.kinds.push_back(kindOf(cell, decimal));
    rows.push_back(std::move(row));
  }
  return rows;
}

// Whether most of the rows after the first one have a value where the first one has a text.
bool namesColumns(const std::vector<SampleRow>& rows) {
  if (rows.empty() || std::none_of(rows[0].kinds.begin(), rows[0].kinds.end(), isText))
    return false;
  if (rows.size() == 1) return std::none_of(rows[0].kinds.begin(), rows[0].kinds.end(), isValue);
  for (std::size_t c = 0; c < rows[0].kinds.size(); ++c) {
    if (!isText(rows[0].kinds[c])) continue;
    std::size_t values = 0;
    for (std::size_t i = 1; i < rows.size(); ++i)
      values += c < rows[i].kinds.size() && isValue(rows[i].kinds[c]) ? 1 : 0;
    if (2 * values >= rows.size() - 1 && values > 0) return true;
  }
  return false;
}

// Whether the cells are 0, 1, 2, .. or 1, 2, 3, .., as programs name columns that have no names
// (the first one may be empty), and the next row is not.
bool countsColumns(const Cells& cells) {
  constexpr std::size_t kFewest = 8;  // fewer may be values
  if (cells.size() < kFewest) return false;
  const std::size_t first = trimmedCell(cells[0]).empty() ? 1 : 0;
  const auto start = parseInteger(trimmedCell(cells[first]));
  if (!start || *start < 0 || *start > 1) return false;
  for (std::size_t i = first; i < cells.size(); ++i)
    if (parseInteger(trimmedCell(cells[i])) != *start + static_cast<std::int64_t>(i - first))
      return false;
  return true;
}

// Whether a row after the names holds units.
bool holdsUnits(const SampleRow& row, const Cells& cells) {
  if (std::any_of(row.kinds.begin(), row.kinds.end(), isValue)) return false;
  std::size_t units = 0;
  std::size_t texts = 0;
  for (const std::string_view cell : cells) {
    std::string_view text = trimmedCell(cell);
    if (text.empty()) continue;
    ++texts;
    const bool bracketed = text.size() > 2 && (text.front() == '[' || text.front() == '(');
    units += bracketed || isKnownUnit(text) ? 1 : 0;
  }
  return texts > 0 && 2 * units >= texts;
}

std::string withoutBrackets(std::string_view text) {
  text = trimmedCell(text);
  const bool bracketed = text.size() > 2 && ((text.front() == '[' && text.back() == ']') ||
                                             (text.front() == '(' && text.back() == ')'));
  return std::string(bracketed ? trimmed(text.substr(1, text.size() - 2)) : text);
}

// `,` after the last value of each row makes an empty column.
void dropEmptyEnd(CsvShape& shape, const Candidate& table, std::size_t firstRow) {
  if (shape.columns.size() < 2) return;
  if (shape.nameLine != 0 && !shape.columns.back().name.empty()) return;
  for (std::size_t i = firstRow; i < table.rows.size(); ++i) {
    const Cells& row = table.rows[i];
    if (row.size() == table.numCells && !trimmedCell(row.back()).empty()) return;
  }
  shape.columns.pop_back();
}

// Which form the dates of a column have.
void describeDates(TableColumn& column,
                   std::size_t c,
                   const Candidate& table,
                   const std::vector<SampleRow>& rows) {
  std::vector<std::string_view> dates;
  for (const SampleRow& row : rows)
    if (c < row.kinds.size() && row.kinds[c] == CellKind::kDate)
      dates.push_back(trimmedCell(table.rows[row.index][c]));
  column.dateForm = dateFormOf(dates);
  column.isDayOnly = std::all_of(dates.begin(), dates.end(), [](std::string_view date) {
    return date.find(':') == std::string_view::npos;
  });
}

// Where each row has one cell more than the names, the names are those of the columns behind the
// first one, as R's write.table writes them: that one has the names of the rows, unless it has
// other numbers.
void shiftNames(CsvShape& shape, const Candidate& table, std::size_t nameRow) {
  if (table.rows[nameRow].size() + 1 != table.numCells || table.numCells < 3) return;
  bool countsRows = true;
  std::int64_t last = 0;
  for (std::size_t i = nameRow + 1; i < table.rows.size(); ++i) {
    const Cells& row = table.rows[i];
    if (row.size() != table.numCells) continue;
    if (trimmedCell(row.back()).empty()) return;  // an empty end
    const auto number = parseInteger(trimmedCell(row[0]));
    const bool isText = !cellNumber(row[0], shape.decimal) && !isDateText(trimmedCell(row[0]));
    countsRows = countsRows && (isText || number == last + 1);
    last = number.value_or(last);
  }
  for (std::size_t c = shape.columns.size() - 1; c > 0; --c)
    shape.columns[c].name = shape.columns[c - 1].name;
  shape.columns[0].name = countsRows ? std::string(kRowNames) : "";
}

// Marks the columns that hold dates or texts.
void describeCells(CsvShape& shape,
                   const Candidate& table,
                   const std::vector<SampleRow>& rows,
                   std::size_t firstRow) {
  for (std::size_t c = 0; c < shape.columns.size(); ++c) {
    std::size_t dates = 0;
    std::size_t texts = 0;
    std::size_t numbers = 0;
    for (const SampleRow& row : rows) {
      if (row.index < firstRow || c >= row.kinds.size()) continue;
      dates += row.kinds[c] == CellKind::kDate ? 1 : 0;
      texts += row.kinds[c] == CellKind::kText ? 1 : 0;
      if ((row.kinds[c] == CellKind::kText && texts == 1) ||
          (row.kinds[c] == CellKind::kDate && shape.columns[c].example.empty()))
        shape.columns[c].example = std::string(trimmedCell(table.rows[row.index][c]));
      numbers += row.kinds[c] == CellKind::kNumber ? 1 : 0;
    }
    TableColumn& column = shape.columns[c];
    column.hasDates = dates > 0 && dates >= texts + numbers;
    column.isNumeric = !column.hasDates && (numbers > 0 || texts == 0);
    if (column.isNumeric) column.example.clear();
    if (column.hasDates) describeDates(column, c, table, rows);
    column.type = column.hasDates ? "date" : column.isNumeric ? "number" : "text";
    if (column.unit.empty()) column.unit = unitInName(column.name);
  }
}

void requireDecimalPoints(const std::filesystem::path& path,
                          const Candidate& table,
                          const std::vector<SampleRow>& rows,
                          const std::vector<std::uint64_t>& lineNumbers) {
  std::size_t commas = 0;
  std::size_t numbers = 0;
  bool mayBeOfThousands = true;  // all of them
  const SampleRow* first = nullptr;
  for (const SampleRow& row : rows)
    for (std::size_t c = 0; c < row.kinds.size(); ++c) {
      numbers += row.kinds[c] == CellKind::kNumber ? 1 : 0;
      if (row.kinds[c] != CellKind::kDecimalComma) continue;
      ++commas;
      mayBeOfThousands = mayBeOfThousands && mayBeThousands(table.rows[row.index][c]);
      if (!first) first = &row;
    }
  if (!first || 10 * commas < numbers) return;
  const auto at = std::find(first->kinds.begin(), first->kinds.end(), CellKind::kDecimalComma);
  const auto column = static_cast<std::size_t>(at - first->kinds.begin());
  throw FormatError(
      path,
      "line " + std::to_string(lineNumbers[first->index]) + ", column " +
          std::to_string(column + 1) + ": " +
          inQuotes(trimmedCell(table.rows[first->index][column])) +
          (mayBeOfThousands ? " has a comma of thousands or a decimal comma; save the file without "
                              "commas of thousands, or read it with --decimal comma"
                            : " has a decimal comma; read the file with --decimal comma"));
}

// Where commas stand between cells, those with decimal commas are in quotes.
void requireQuotedCommas(const std::filesystem::path& path,
                         const Candidate& table,
                         const std::vector<SampleRow>& rows,
                         const TableOptions& options) {
  if (table.delimiter != options.decimal) return;
  for (const SampleRow& row : rows)
    for (std::size_t c = 0; c < row.kinds.size(); ++c)
      if (row.kinds[c] == CellKind::kNumber &&
          table.rows[row.index][c].find(options.decimal) != std::string_view::npos)
        return;
  throw FormatError(path,
                    "decimal commas need another delimiter than a comma, or quotes around the "
                    "cells");
}

// The sample without the times of a serial monitor, if most lines have one.
SampleLines withoutStamps(std::vector<std::string_view> lines) {
  SampleLines sample{lines, {}};
  std::size_t such = 0;
  for (std::string_view& line : lines) {
    sample.stamps.push_back(takeStamp(line));
    such += sample.stamps.back().empty() ? 0 : 1;
  }
  if (2 * such <= lines.size()) return {std::move(sample.texts), {}};
  sample.texts = std::move(lines);
  return sample;
}

TableColumn stampColumn(const SampleLines& sample) {
  TableColumn column{.name = "stamp"};
  column.type = "date";
  column.isNumeric = false;
  column.hasDates = true;
  column.dateForm = DateForm::kClock;
  for (const std::string_view stamp : sample.stamps)
    if (!stamp.empty() && !parseDate(stamp, nullptr, TimeUnit::kClock))
      column.dateForm = DateForm::kIso;
  return column;
}

// The shape of name:value lines; nothing when most lines are of another form.
std::optional<CsvShape> labelledShape(const SampleLines& sample, char decimal) {
  const auto& lines = sample.texts;
  std::size_t such = 0;
  Cells names;
  Cells values;
  Cells longest;
  for (const std::string_view line : lines) {
    if (!splitLabelled(line, names, values)) continue;
    ++such;
    if (names.size() > longest.size()) longest = names;
  }
  if (such == 0 || 2 * such <= lines.size()) return std::nullopt;
  CsvShape shape;
  shape.labelled = true;
  shape.stamped = !sample.stamps.empty();
  shape.delimiter = ' ';
  shape.decimal = decimal;
  if (shape.stamped) shape.columns.push_back(stampColumn(sample));
  for (const std::string_view name : longest) {
    TableColumn column{.name = std::string(name), .unit = unitInName(name)};
    column.type = "number";
    shape.columns.push_back(std::move(column));
  }
  return shape;
}

// The shape of a line per matrix; nothing when most lines are of another form.
std::optional<CsvShape> padShape(const SampleLines& sample, const TableOptions& options) {
  constexpr std::size_t kMaxPads = 256;
  CsvShape shape;
  shape.stamped = !sample.stamps.empty();
  shape.decimal = options.decimal;
  std::map<std::string_view, std::map<std::size_t, std::size_t>> counts;  // of numbers, by name
  std::size_t such = 0;
  Cells cells;
  for (const std::string_view line : sample.texts) {
    const auto pad = splitPadLine(line);
    if (!pad) continue;
    if (such == 0) {
      const auto between = pad->values.find_first_of(",;\t ");
      shape.delimiter = options.delimiter != 0              ? options.delimiter
                        : between == std::string_view::npos ? ','
                                                            : pad->values[between];
    }
    splitCells(pad->values, shape.delimiter, cells);
    if (std::any_of(cells.begin(), cells.end(), [&](std::string_view cell) {
          const CellKind kind = kindOf(cell, options.decimal);
          return kind != CellKind::kNumber && kind != CellKind::kEmpty;
        }))
      continue;
    ++such;
    if (counts.count(pad->name) == 0) shape.pads.push_back({std::string(pad->name), 0, 0});
    ++counts[pad->name][cells.size()];
  }
  if (such == 0 || 2 * such <= sample.texts.size() || shape.pads.size() > kMaxPads)
    return std::nullopt;
  if (shape.stamped) shape.columns.push_back(stampColumn(sample));
  for (PadColumns& pad : shape.pads) {
    const auto& byCount = counts[pad.name];
    const auto most =
        std::max_element(byCount.begin(), byCount.end(), [](const auto& one, const auto& other) {
          return one.second < other.second;
        });
    pad.first = shape.columns.size();
    pad.count = most->first;
    for (std::size_t i = 0; i < pad.count; ++i)
      shape.columns.push_back(
          {.name = pad.count == 1 ? pad.name : pad.name + "[" + std::to_string(i) + "]",
           .type = "number"});
  }
  return shape;
}

// Which lists the lines have, and the names of their cells; nothing when most lines have none.
std::optional<CsvShape> nestedForm(const SampleLines& sample, const TableOptions& options) {
  const auto& lines = sample.texts;
  const auto areMost = [&](std::size_t such) { return 2 * such > lines.size(); };
  CsvShape shape;
  shape.nested = true;
  shape.stamped = !sample.stamps.empty();
  shape.decimal = options.decimal;
  if (areMost(static_cast<std::size_t>(std::count_if(
          lines.begin(), lines.end(), [](std::string_view line) { return isNestedText(line); }))))
    return shape;
  for (const char delimiter : {',', ';', '\t'}) {
    if (options.delimiter != 0 && delimiter != options.delimiter) continue;
    Cells cells;
    Cells first;  // with a list
    std::size_t such = 0;
    for (const std::string_view line : lines) {
      splitNestedCells(line, delimiter, cells);
      if (cells.size() < 2 || std::none_of(cells.begin(), cells.end(), isNestedText)) continue;
      if (such++ == 0) first = cells;
    }
    if (!areMost(such)) continue;
    shape.delimiter = delimiter;
    splitNestedCells(lines.front(), delimiter, cells);
    const bool named = cells.size() == first.size() && options.header != HeaderChoice::kAbsent &&
                       std::none_of(cells.begin(), cells.end(), [&](std::string_view cell) {
                         return isNestedText(cell) || isValue(kindOf(cell, options.decimal));
                       });
    for (std::size_t c = 0; c < first.size(); ++c)
      shape.cellNames.push_back(named ? std::string(trimmedCell(cells[c]))
                                      : "column " + std::to_string(c + 1));
    shape.nameLine = named ? 1 : 0;
    return shape;
  }
  return std::nullopt;
}

// The values of a line in the order of these names, as far as it has them.
NestedLine inOrderOf(const std::vector<std::string>& names, const NestedLine& line) {
  std::map<std::string_view, std::string_view> values;
  for (std::size_t i = 0; i < line.names.size(); ++i) values[line.names[i]] = line.values[i];
  NestedLine ordered;
  for (const std::string& name : names) ordered.values.push_back(values[name]);
  return ordered;
}

// The shape of lines with lists in them; nothing when most lines have none.
std::optional<CsvShape> nestedShape(const SampleLines& sample, const TableOptions& options) {
  auto shape = nestedForm(sample, options);
  if (!shape) return std::nullopt;
  // The names are those of a line with as many values as most have.
  std::map<std::size_t, std::size_t> counts;
  std::map<std::size_t, std::vector<std::string>> namesBySize;
  Candidate table;
  std::string fault;
  for (std::size_t i = shape->nameLine != 0 ? 1 : 0; i < sample.texts.size(); ++i) {
    NestedLine each;
    if (!splitNested(sample.texts[i], *shape, each)) {
      if (fault.empty()) fault = each.fault;
      continue;
    }
    ++counts[each.names.size()];
    const auto [known, isNew] = namesBySize.try_emplace(each.names.size(), std::move(each.names));
    if (!isNew && each.names != known->second) each = inOrderOf(known->second, each);
    table.rows.push_back(std::move(each.values));
  }
  if (counts.empty() && !fault.empty())
    throw Error("each line" + fault + "; name them differently, or save a list for each");
  if (counts.empty()) return std::nullopt;
  const auto most =
      std::max_element(counts.begin(), counts.end(), [](const auto& one, const auto& other) {
        return one.second < other.second;
      });
  const std::vector<std::string>& names = namesBySize[most->first];
  for (const std::string& name : names) shape->columns.push_back({.name = name});
  table.numCells = names.size();
  describeCells(*shape, table, fullRows(table, options.decimal), 0);
  if (shape->stamped) shape->columns.insert(shape->columns.begin(), stampColumn(sample));
  return shape;
}

}  // namespace

bool splitNested(std::string_view line, const CsvShape& shape, NestedLine& values) {
  values.names.clear();
  values.values.clear();
  values.fault.clear();
  if (shape.cellNames.empty() &&
      !flattenNested(trimmed(line), trimmed(line).starts_with('{') ? "" : "list", values))
    return false;
  Cells cells;
  if (!shape.cellNames.empty()) splitNestedCells(line, shape.delimiter, cells);
  if (cells.size() != shape.cellNames.size()) return false;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::string_view cell = trimmedCell(cells[c]);
    if (isNestedText(cell)) {
      if (!flattenNested(cell, shape.cellNames[c], values)) return false;
    } else {
      values.names.push_back(shape.cellNames[c]);
      values.values.push_back(cell);
    }
  }
  useGivenNames(values);
  return values.fault.empty();
}

void splitCells(std::string_view line, char delimiter, std::vector<std::string_view>& cells) {
  cells.clear();
  const bool blanks = delimiter == ' ';
  if (blanks) line = trimmed(line);
  std::size_t at = 0;
  while (true) {
    std::size_t end = at;
    // A quoted cell ends at its quote; two quotes stand for one.
    std::size_t start = at;
    while (!blanks && start < line.size() && line[start] == ' ' && delimiter != ' ') ++start;
    if (start < line.size() && line[start] == '"') {
      end = start + 1;
      while (end < line.size() &&
             (line[end] != '"' || (end + 1 < line.size() && line[end + 1] == '"')))
        end += line[end] == '"' ? 2 : 1;
    }
    const auto found = blanks ? line.find_first_of(" \t", end) : line.find(delimiter, end);
    if (found == std::string_view::npos || cells.size() == kMaxNumbersPerRow) {
      cells.push_back(line.substr(at));
      return;
    }
    cells.push_back(line.substr(at, found - at));
    at = blanks ? line.find_first_not_of(" \t", found) : found + 1;
  }
}

std::string_view takeStamp(std::string_view& line) {
  constexpr std::string_view kArrow = " -> ";
  const bool bracketed = line.starts_with('[');
  const std::size_t end = bracketed ? line.find(']') : line.find(kArrow);
  if (end == std::string_view::npos) return {};
  const std::string_view stamp = trimmed(line.substr(bracketed ? 1 : 0, end - (bracketed ? 1 : 0)));
  if (!isDateText(stamp)) return {};
  line.remove_prefix(end + (bracketed ? 1 : kArrow.size()));
  line = trimmed(line, " ");
  return stamp;
}

bool splitLabelled(std::string_view line,
                   std::vector<std::string_view>& names,
                   std::vector<std::string_view>& values) {
  constexpr std::string_view kBetween = " \t,;";
  names.clear();
  values.clear();
  line = trimmed(line);
  if (line.starts_with('>')) line.remove_prefix(1);  // as Teleplot reads it
  std::size_t at = line.find_first_not_of(kBetween);
  while (at != std::string_view::npos) {
    const auto colon = line.find_first_of(":=", at);
    if (colon == std::string_view::npos) return false;
    const std::string_view name = trimmed(line.substr(at, colon - at));
    // A name has a letter first, so that 10:31:05 is none.
    const bool isName =
        !name.empty() && name.find_first_of(",;\t") == std::string_view::npos &&
        (name[0] == '_' || name[0] == '/' ||
         (smallLetters(name.substr(0, 1))[0] >= 'a' && smallLetters(name.substr(0, 1))[0] <= 'z'));
    if (!isName || names.size() == kMaxNumbersPerRow) return false;
    const auto value = line.find_first_not_of(" \t", colon + 1);
    const auto end = std::min(line.find_first_of(kBetween, value), line.size());
    names.push_back(name);
    values.push_back(value == std::string_view::npos ? std::string_view()
                                                     : line.substr(value, end - value));
    at = line.find_first_not_of(kBetween, end);
  }
  return !names.empty();
}

std::optional<PadLine> splitPadLine(std::string_view line) {
  const auto colon = line.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  PadLine pad;
  pad.name = trimmed(line.substr(0, colon));
  pad.values = trimmed(line.substr(colon + 1));
  const auto blank = pad.name.rfind(' ');
  if (blank != std::string_view::npos) {
    pad.frame = parseInteger(pad.name.substr(blank + 1));
    if (pad.frame) pad.name = trimmed(pad.name.substr(0, blank));
  }
  const bool isName = !pad.name.empty() && pad.name.find_first_of(",;\t\"") == std::string::npos &&
                      std::isalpha(static_cast<unsigned char>(pad.name[0])) != 0;
  return isName ? std::optional(pad) : std::nullopt;
}

bool isCommentLine(std::string_view line) {
  line = trimmed(line);
  return line.empty() || line[0] == '#' || line[0] == '%' || line.starts_with("//");
}

CsvShape detectCsvShape(const std::filesystem::path& path,
                        const std::vector<std::string>& lines,
                        const TableOptions& options) {
  std::vector<std::string_view> kept;
  std::vector<std::uint64_t> numbers;  // of the kept lines
  std::optional<std::size_t> lastComment;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!isCommentLine(lines[i])) {
      kept.emplace_back(lines[i]);
      numbers.push_back(i + 1);
    } else if (kept.empty() && !trimmed(lines[i]).empty()) {
      lastComment = i;
    }
  }
  if (kept.empty()) throw FormatError(path, "holds no row");
  if (const std::string_view first = trimmed(kept.front()); first == "[" || first == "{")
    throw FormatError(path,
                      "is JSON over several lines; save an object in each line, one for each "
                      "frame: {\"time\": 0.05, \"pad\": [1, 2, 3]}");
  const SampleLines sample = withoutStamps(std::move(kept));
  if (options.delimiter == 0)
    if (auto labelled = labelledShape(sample, options.decimal)) return std::move(*labelled);
  if (auto pads = padShape(sample, options)) return std::move(*pads);
  std::optional<CsvShape> nested;
  try {
    nested = nestedShape(sample, options);
  } catch (const Error& error) {
    throw FormatError(path, error.what());
  }
  if (nested) {
    for (const TableColumn& column : nested->columns)
      if (column.example == "...")
        throw FormatError(path,
                          inQuotes(column.name) +
                              " is \"...\": NumPy left numbers out where it printed the array; "
                              "save it as .npz");
    if (nested->nameLine != 0) nested->nameLine = numbers.front();
    return std::move(*nested);
  }

  const Candidate table = bestCandidate(sample, options);
  if (table.numCells > kMaxNumbersPerRow)
    throw FormatError(path, "has more than " + std::to_string(kMaxNumbersPerRow) + " columns");
  const std::vector<SampleRow> rows = fullRows(table, options.decimal);
  CsvShape shape;
  shape.delimiter = table.delimiter;
  shape.decimal = options.decimal;
  shape.stamped = !sample.stamps.empty();
  shape.columns.resize(table.numCells);
  std::size_t firstRow = 0;  // in the sample
  const bool named =
      options.header == HeaderChoice::kPresent ||
      (options.header == HeaderChoice::kDetect &&
       (namesColumns(rows) || (rows.size() > 1 && countsColumns(table.rows[rows[0].index]) &&
                               !countsColumns(table.rows[rows[1].index]))));
  const auto nameFrom = [&](const Cells& cells) {
    for (std::size_t c = 0; c < std::min(cells.size(), shape.columns.size()); ++c)
      shape.columns[c].name = std::string(trimmedCell(cells[c]));
  };
  if (named && !rows.empty()) {
    const std::size_t at = rows[0].index;
    nameFrom(table.rows[at]);
    shiftNames(shape, table, at);
    shape.nameLine = numbers[at];
    firstRow = at + 1;
    if (rows.size() > 1 && holdsUnits(rows[1], table.rows[rows[1].index])) {
      const Cells& units = table.rows[rows[1].index];
      for (std::size_t c = 0; c < std::min(units.size(), shape.columns.size()); ++c)
        shape.columns[c].unit = withoutBrackets(units[c]);
      shape.unitLine = numbers[rows[1].index];
      firstRow = rows[1].index + 1;
    }
    shape.linesBefore = numbers[firstRow - 1];
  } else if (lastComment && options.header != HeaderChoice::kAbsent) {
    // Names in a comment, as numpy.savetxt writes them.
    Cells cells;
    splitCells(trimmed(lines[*lastComment], " \t#%/"), table.delimiter, cells);
    if (cells.size() == table.numCells && cells.size() > 1) {
      nameFrom(cells);
      shape.nameLine = *lastComment + 1;
    }
  }
  if (shape.stamped) shape.columns.front() = stampColumn(sample);
  requireDecimalPoints(path, table, rows, numbers);
  requireQuotedCommas(path, table, rows, options);
  dropEmptyEnd(shape, table, firstRow);
  describeCells(shape, table, rows, firstRow);
  if (shape.columns.front().name == kRowNames) {
    shape.columns.front().type = "text";
    shape.columns.front().isNumeric = shape.columns.front().hasDates = false;
  }
  if (std::none_of(shape.columns.begin(), shape.columns.end(), [](const TableColumn& column) {
        return column.type == "number";
      }))
    throw FormatError(path,
                      "line " + std::to_string(numbers[0]) +
                          ": holds no numbers: not a table (cells are separated by commas, "
                          "semicolons, tabs or blanks)");
  for (std::size_t c = 0; c < shape.columns.size(); ++c)
    if (shape.columns[c].name.empty()) shape.columns[c].name = "column " + std::to_string(c + 1);
  return shape;
}

}  // namespace palpate

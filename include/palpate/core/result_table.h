// A table of results: columns with a name, a unit and a kind, and rows that are computed when they
// are read, once and in order. The columns of a result are described once, beside its type; CSV,
// JSON, Python and files of other programs are written from any table.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <palpate/core/output_file.h>

namespace palpate {

enum class CellKind { kInteger, kNumber, kFlag, kText };
const char* nameOf(CellKind kind) noexcept;  // "integer", "number", "flag", "text"

// The value of a column in a row, of the column's kind; nothing where it isn't known.
using Cell = std::variant<std::monostate, std::int64_t, double, bool, std::string>;
// `value` where it is known.
inline std::optional<double> knownIf(bool known, double value) {
  return known ? std::optional(value) : std::nullopt;
}

struct ResultColumn {
  std::string name;  // "ref_dx"; unique in its table
  CellKind kind = CellKind::kNumber;
  std::string unit = {};  // "mm", "taxels"; empty: none
  std::string meaning =
      {};             // for the page of all columns: "motion since the reference, to the right"
  int decimals = -1;  // of a number as text; -1: as many as read back as the same number
};

// The number of a cell: of a flag 0 or 1; NaN where it isn't known, and for texts.
double numberOf(const Cell& cell);

class ResultTable {
 public:
  ResultTable(std::string name, std::vector<ResultColumn> columns);
  virtual ~ResultTable() = default;
  const std::string& name() const noexcept { return name_; }  // "slip"
  const std::vector<ResultColumn>& columns() const noexcept { return columns_; }
  // Computes the next row, one cell per column; returns false after the last one. Throws what
  // computing it throws: FileError, Cancelled.
  virtual bool next(std::vector<Cell>& cells) = 0;
  // Behind the last row: what its reader should know, and what the rows lack, a line each.
  virtual std::vector<std::string> notes() const { return notes_; }
  virtual std::vector<std::string> problems() const { return {}; }
  void note(std::string line) { notes_.push_back(std::move(line)); }

 private:
  std::string name_;
  std::vector<ResultColumn> columns_;
  std::vector<std::string> notes_;
};

// A column, and how its cell is made of what a row is about.
template <typename Row>
struct ColumnOf {
  ResultColumn column;
  std::function<Cell(const Row&)> cell;
};

// The column of what `of` returns for a row: a whole number, a number, a flag, a text, or an
// std::optional of one of them.
template <typename Row, typename Of>
ColumnOf<Row> columnOf(std::string name, std::string unit, std::string meaning, Of of) {
  using Result = std::remove_cvref_t<std::invoke_result_t<Of, const Row&>>;
  constexpr bool isOptional = requires(Result result) { result.value(); };
  const auto made = [](const auto& value) -> Cell {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, bool>)
      return value;
    else if constexpr (std::is_integral_v<Value>)
      return static_cast<std::int64_t>(value);
    else if constexpr (std::is_floating_point_v<Value>)
      return static_cast<double>(value) + 0.0;  // never -0
    else
      return std::string(value);
  };
  using Made = decltype([] {
    if constexpr (isOptional)
      return typename Result::value_type();
    else
      return Result();
  }());
  constexpr CellKind kind = std::is_same_v<Made, bool>       ? CellKind::kFlag
                            : std::is_integral_v<Made>       ? CellKind::kInteger
                            : std::is_floating_point_v<Made> ? CellKind::kNumber
                                                             : CellKind::kText;
  return {{std::move(name), kind, std::move(unit), std::move(meaning)},
          [of = std::move(of), made](const Row& row) -> Cell {
            if constexpr (isOptional) {
              const auto value = std::invoke(of, row);
              return value ? made(*value) : Cell();
            } else {
              return made(std::invoke(of, row));
            }
          }};
}
// The same, with a fixed number of decimals as text.
template <typename Row, typename Of>
ColumnOf<Row> columnOf(
    std::string name, std::string unit, std::string meaning, Of of, int decimals) {
  ColumnOf<Row> column =
      columnOf<Row>(std::move(name), std::move(unit), std::move(meaning), std::move(of));
  column.column.decimals = decimals;
  return column;
}

// A column of numbers as they are, -0 too; nothing where one isn't finite.
template <typename Row, typename Of>
ColumnOf<Row> finiteColumn(
    std::string name, std::string unit, std::string meaning, Of of, int decimals = -1) {
  return {{std::move(name), CellKind::kNumber, std::move(unit), std::move(meaning), decimals},
          [of = std::move(of)](const Row& row) -> Cell {
            const double value = std::invoke(of, row);
            return std::isfinite(value) ? Cell(value) : Cell();
          }};
}

template <typename Row>
std::vector<ResultColumn> columnsOf(const std::vector<ColumnOf<Row>>& columns) {
  std::vector<ResultColumn> heads;
  for (const ColumnOf<Row>& each : columns) heads.push_back(each.column);
  return heads;
}

// Throws std::out_of_range when there is none of this name.
template <typename Row>
const ColumnOf<Row>& columnNamed(const std::vector<ColumnOf<Row>>& columns, std::string_view name) {
  for (const ColumnOf<Row>& each : columns)
    if (each.column.name == name) return each;
  throw std::out_of_range("there is no column '" + std::string(name) + "'");
}

// The columns of a part of a row: of what `part` returns.
template <typename Row, typename Part, typename Of>
void appendColumns(std::vector<ColumnOf<Row>>& columns,
                   const std::vector<ColumnOf<Part>>& ofPart,
                   Of part) {
  for (const ColumnOf<Part>& each : ofPart)
    columns.push_back(
        {each.column, [cell = each.cell, part](const Row& row) { return cell(part(row)); }});
}

// A table whose rows are made in batches.
template <typename Row>
class RowTable : public ResultTable {
 public:
  // Appends the next rows, perhaps none; returns false when no more will follow.
  using More = std::function<bool(std::vector<Row>& rows)>;

  RowTable(std::string name, std::vector<ColumnOf<Row>> columns, More more)
      : ResultTable(std::move(name), columnsOf(columns)),
        cells_(std::move(columns)),
        more_(std::move(more)) {}
  // Of rows that are there already.
  RowTable(std::string name, std::vector<ColumnOf<Row>> columns, std::vector<Row> rows)
      : RowTable(std::move(name), std::move(columns), [](std::vector<Row>&) { return false; }) {
    rows_ = std::move(rows);
  }

  bool next(std::vector<Cell>& cells) override {
    while (at_ == rows_.size()) {
      if (!more_) return false;
      rows_.clear();
      at_ = 0;
      if (!more_(rows_)) more_ = nullptr;
    }
    const Row& row = rows_[at_++];
    cells.resize(cells_.size());
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = cells_[i].cell(row);
    return true;
  }

 private:
  std::vector<ColumnOf<Row>> cells_;
  More more_;
  std::vector<Row> rows_;
  std::size_t at_ = 0;
};

enum class TableForm { kCsv, kJson };

// How a table is written as text.
struct TableTextOptions {
  TableForm form = TableForm::kCsv;
  bool unitsRow = false;       // of CSV: a second row with the units
  std::string addedName = {};  // of a last column that `TableText::row` fills; empty: none
};

// One table as text, of one source of rows or of several with the same columns. CSV: a line for the
// names, one for each row; a cell that isn't known is empty. JSON: one object {"table", "columns":
// [{"name", "unit", "kind"}], "rows": [{name: value, ..}, ..]}; null where it isn't known.
class TableText {
 public:
  // `added`: the text of the added column, the same in each row.
  TableText(const ResultTable& table, TableTextOptions options, const std::string& added = {});
  std::string begin() const;  // the names, and the units where they are wanted
  // Appends a row. Rows of JSON begin with a comma, except the first row of the whole text, whose
  // comma the caller leaves out.
  void appendRow(std::string& text, const std::vector<Cell>& cells) const;

 private:
  std::string name_;
  std::vector<ResultColumn> columns_;
  TableTextOptions options_;
  std::vector<std::string> beforeCells_;  // separators, and of JSON the names
  std::string afterRow_;                  // the added column and what ends a row
};

inline constexpr const char* kJsonTableEnd = "\n]\n}\n";  // behind the last row of JSON

// Passes the whole text of a table to `sink`, in pieces. Returns the number of rows.
std::size_t writeTableText(ResultTable& table,
                           const TableTextOptions& options,
                           const std::function<void(const std::string& text)>& sink);
// The same as a file; a failure leaves no partial one. Throws FileError, and what the rows throw.
std::size_t writeTableFile(ResultTable& table,
                           const std::filesystem::path& path,
                           Overwrite overwrite = Overwrite::kRefuse,
                           const TableTextOptions& options = {});
// JSON where the ending is ".json", else CSV.
TableForm tableFormOf(const std::filesystem::path& path);

}  // namespace palpate

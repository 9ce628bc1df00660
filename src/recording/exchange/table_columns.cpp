// The forms of result tables (result_writers.h) that are written column by column.
#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/utf8.h"
#include "palpate/recording/result_file.h"

#include "recording/exchange/mat_file.h"
#include "recording/exchange/npz_file.h"
#include "recording/result_writers.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kTextRoomBytes = 256;  // of a text, besides its characters

// The cells of a column. What isn't known: of numbers NaN, of texts the empty one. A column of
// whole numbers or flags with such cells becomes one of numbers.
class TableColumn {
 public:
  explicit TableColumn(CellKind kind) : kind_(kind) {}

  // Returns the bytes that it takes.
  std::size_t add(const Cell& cell) {
    if (kind_ == CellKind::kText) {
      const auto* text = std::get_if<std::string>(&cell);
      texts_.push_back(text ? *text : "");
      return kTextRoomBytes + 4 * texts_.back().size();
    }
    if (kind_ == CellKind::kNumber) {
      bits_.push_back(std::bit_cast<std::int64_t>(numberOf(cell)));
    } else if (const auto* whole = std::get_if<std::int64_t>(&cell)) {
      bits_.push_back(*whole);
    } else if (const auto* flag = std::get_if<bool>(&cell)) {
      bits_.push_back(*flag ? 1 : 0);
    } else {
      unknown_.push_back(bits_.size());
      bits_.push_back(0);
    }
    return sizeof(std::int64_t);
  }

  CellKind kind() const { return unknown_.empty() ? kind_ : CellKind::kNumber; }
  std::size_t size() const { return kind_ == CellKind::kText ? texts_.size() : bits_.size(); }
  std::int64_t whole(std::size_t row) const { return bits_[row]; }
  double number(std::size_t row) const {
    if (kind_ == CellKind::kNumber) return std::bit_cast<double>(bits_[row]);
    if (std::binary_search(unknown_.begin(), unknown_.end(), row))
      return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(bits_[row]);
  }
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  CellKind kind_;
  std::vector<std::int64_t> bits_;    // of numbers their bits
  std::vector<std::size_t> unknown_;  // rows, ascending
  std::vector<std::string> texts_;
};

std::vector<TableColumn> columnsIn(ResultTable& table, const fs::path& path, Overwrite overwrite) {
  requireWritable(path, overwrite);
  std::vector<TableColumn> columns;
  for (const ResultColumn& each : table.columns()) columns.emplace_back(each.kind);
  std::size_t bytes = 0;
  for (std::vector<Cell> cells; table.next(cells);) {
    for (std::size_t c = 0; c < columns.size(); ++c) bytes += columns[c].add(cells[c]);
    if (bytes > kMaxColumnBytes)
      throw FileError(path,
                      "has too many values for this form (1 GB in memory); write .h5 or .csv");
  }
  return columns;
}

std::size_t rowCountOf(const std::vector<TableColumn>& columns) {
  return columns.empty() ? 0 : columns[0].size();
}

void writeNpyTexts(ZipWriter& zip,
                   const std::string& name,
                   const std::vector<std::string>& texts,
                   const fs::path& path) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, codePointsOf(text).size());
  // Each text takes the room of the longest.
  if (texts.size() > kMaxColumnBytes / (4 * width))
    throw FileError(path,
                    "can't hold the column '" + shortened(name) +
                        "': with a text that long it would have more than 1 GB; write .h5 or .csv");
  NpyArray array(zip, name, "<U" + std::to_string(width), 4 * width, {texts.size()});
  for (const std::string& text : texts) {
    std::u32string codes = codePointsOf(text);
    codes.resize(width);
    for (const char32_t code : codes) array.u32(code);
  }
  array.end();
}

void writeNpyColumn(ZipWriter& zip, const std::string& name, const TableColumn& column) {
  const CellKind kind = column.kind();
  const bool isFlag = kind == CellKind::kFlag;
  const char* type = isFlag ? "|b1" : kind == CellKind::kInteger ? "<i8" : "<f8";
  NpyArray array(zip, name, type, isFlag ? 1 : 8, {column.size()});
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (isFlag)
      array.u8(static_cast<std::uint64_t>(column.whole(i)));
    else if (kind == CellKind::kInteger)
      array.i64(column.whole(i));
    else
      array.f64(column.number(i));
  }
  array.end();
}

template <typename Number, typename Of>
MatValue matColumn(MatNumber type, std::size_t count, Of of) {
  return MatValue::numbers(type, {count, 1}, [count, of](const MatSink& sink) {
    for (std::size_t i = 0; i < count; ++i) {
      const Number value = static_cast<Number>(of(i));
      sink({reinterpret_cast<const char*>(&value), sizeof value});
    }
  });
}

// The column must outlive the value.
MatValue matColumnOf(const TableColumn& column) {
  const std::size_t count = column.size();
  const auto whole = [&column](std::size_t row) { return column.whole(row); };
  switch (column.kind()) {
    case CellKind::kText:
      return MatValue::texts(column.texts());
    case CellKind::kFlag:
      return matColumn<std::uint8_t>(MatNumber::kU8, count, whole);
    case CellKind::kInteger:
      return matColumn<std::int64_t>(MatNumber::kI64, count, whole);
    case CellKind::kNumber:
      break;
  }
  return matColumn<double>(
      MatNumber::kF64, count, [&column](std::size_t row) { return column.number(row); });
}

// Throws FileError where MATLAB can't have a field of this name.
void requireMatName(const std::string& name, const fs::path& path) {
  const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto fits = [&](char c) { return isLetter(c) || (c >= '0' && c <= '9') || c == '_'; };
  if (name.size() > kMaxMatName || name.empty() || !isLetter(name[0]) ||
      !std::all_of(name.begin(), name.end(), fits))
    throw FileError(path,
                    "can't hold the column '" + shortened(name) + "': names have at most " +
                        std::to_string(kMaxMatName) + " letters, digits and _; write .h5 or .npz");
}

}  // namespace

std::size_t writeNpzTable(ResultTable& table, const fs::path& path, Overwrite overwrite) {
  for (const ResultColumn& each : table.columns())
    if (each.name == "meta")
      throw FileError(path, "can't hold the column 'meta': another array has this name; write .h5");
  const std::vector<TableColumn> columns = columnsIn(table, path, overwrite);
  OutputFile out(path, overwrite);
  ZipWriter zip(out);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string& name = table.columns()[c].name;
    if (columns[c].kind() == CellKind::kText)
      writeNpyTexts(zip, name, columns[c].texts(), path);
    else
      writeNpyColumn(zip, name, columns[c]);
  }
  writeNpyText(zip, "meta", headOf(table).asciiText());
  zip.finish();
  out.commit();
  return rowCountOf(columns);
}

std::size_t writeMatTable(ResultTable& table, const fs::path& path, Overwrite overwrite) {
  std::vector<std::string> names, units, meanings;
  for (const ResultColumn& each : table.columns()) {
    requireMatName(each.name, path);
    names.push_back(each.name);
    units.push_back(each.unit);
    meanings.push_back(each.meaning);
  }
  const std::vector<TableColumn> columns = columnsIn(table, path, overwrite);
  std::vector<std::pair<std::string, MatValue>> fields;
  for (std::size_t c = 0; c < columns.size(); ++c)
    fields.emplace_back(names[c], matColumnOf(columns[c]));
  MatFile file(path, overwrite, "palpate");
  file.add(table.name(), MatValue::structure(std::move(fields)));
  file.add("columns",
           MatValue::structure({{"name", MatValue::texts(names)},
                                {"units", MatValue::texts(units)},
                                {"meaning", MatValue::texts(meanings)}}));
  file.commit();
  return rowCountOf(columns);
}

}  // namespace palpate

// writeHdf5Table() of result_writers.h.
#include <utility>

#include "recording/hdf5/hdf5_arrays.h"
#include "recording/hdf5/hdf5_layout.h"
#include "recording/result_writers.h"

namespace palpate {
namespace {

constexpr std::size_t kRowsPerChunk = 4096;

class Hdf5TableWriter : Hdf5Arrays {
 public:
  Hdf5TableWriter(ResultTable& table, const std::filesystem::path& path, Overwrite overwrite)
      : Hdf5Arrays(path, overwrite, {}), table_(table) {}

  std::size_t write() {
    makeColumns();
    std::size_t count = 0;
    for (std::vector<Cell> cells; table_.next(cells);) {
      for (std::size_t c = 0; c < columns_.size(); ++c)
        put(columns_[c], count % kRowsPerChunk, cells[c]);
      if (++count % kRowsPerChunk == 0) addRows(count);
    }
    if (count % kRowsPerChunk != 0) addRows(count);
    finishChunks();
    columns_.clear();
    commit();
    return count;
  }

 private:
  struct TableColumn {
    ChunkedArray* array = nullptr;
    CellKind kind = CellKind::kNumber;
    Bytes bytes;                     // of a chunk
    std::vector<std::string> texts;  // of a chunk
  };

  void makeColumns() {
    const auto lock = hdf5Lock();
    attribute(out_.file(), "format", std::string(hdf5_layout::kTableFormat));
    attribute(out_.file(), "table", table_.name());
    makeGroup(table_.name());
    const Hdf5Id textType = hdf5TextType();
    for (const ResultColumn& each : table_.columns()) {
      const bool isText = each.kind == CellKind::kText;
      const NumberType type = isText                           ? NumberType{textType.get(), 0}
                              : each.kind == CellKind::kFlag   ? u8()
                              : each.kind == CellKind::kNumber ? f64()
                                                               : i64();
      ChunkedArray& array =
          chunkedArray(table_.name() + "/" + each.name, type, {0}, {kRowsPerChunk});
      attribute(array.id.get(), "units", each.unit);
      attribute(array.id.get(), "meaning", each.meaning);
      if (each.kind == CellKind::kInteger)
        attribute(array.id.get(), "missing_value", hdf5_layout::kUnknownInteger);
      if (each.kind == CellKind::kFlag)
        attribute(array.id.get(), "missing_value", std::int64_t{hdf5_layout::kUnknownFlag});
      columns_.push_back({&array, each.kind, Bytes(kRowsPerChunk * type.bytes), {}});
    }
  }

  static void put(TableColumn& column, std::size_t row, const Cell& cell) {
    switch (column.kind) {
      case CellKind::kText: {
        const auto* text = std::get_if<std::string>(&cell);
        column.texts.push_back(text ? *text : "");
        break;
      }
      case CellKind::kFlag: {
        const auto* flag = std::get_if<bool>(&cell);
        Hdf5Arrays::put(
            column.bytes, row, flag ? static_cast<std::uint8_t>(*flag) : hdf5_layout::kUnknownFlag);
        break;
      }
      case CellKind::kInteger: {
        const auto* whole = std::get_if<std::int64_t>(&cell);
        Hdf5Arrays::put(column.bytes, row, whole ? *whole : hdf5_layout::kUnknownInteger);
        break;
      }
      case CellKind::kNumber:
        Hdf5Arrays::put(column.bytes, row, numberOf(cell));
        break;
    }
  }

  // Writes the rows of the chunk that ends before row `end`.
  void addRows(std::size_t end) {
    const hsize_t first = (end - 1) / kRowsPerChunk * kRowsPerChunk;
    for (TableColumn& column : columns_) {
      grow(*column.array, end);
      if (column.kind == CellKind::kText)
        addTexts(*column.array, first, std::exchange(column.texts, {}));
      else
        addChunk(*column.array, {first}, column.bytes);
    }
  }

  ResultTable& table_;
  std::vector<TableColumn> columns_;
};

}  // namespace

std::size_t writeHdf5Table(ResultTable& table,
                           const std::filesystem::path& path,
                           Overwrite overwrite) {
  return Hdf5TableWriter(table, path, overwrite).write();
}

}  // namespace palpate

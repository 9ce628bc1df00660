// Fuzzes tables of text, of NumPy's arrays (.npy, .npz) and of MAT files of version 5: what is read
// has the shape that was announced, and an import writes nothing that a recording can't hold.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/imports/recording_import.h"
#include "palpate/model/hand_description.h"

namespace {

using namespace palpate;
namespace fs = std::filesystem;

void requireTrue(bool condition) {
  if (!condition) std::abort();
}

// A file of this process, removed at its end.
class TableFile {
 public:
  TableFile()
      : path_(fs::temp_directory_path() / ("palpate_table_fuzzer." + std::to_string(::getpid()))) {}
  ~TableFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TableFile(const TableFile&) = delete;
  TableFile& operator=(const TableFile&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

HandDescription smallPad() {
  HandDescription hand;
  hand.name = "pad";
  hand.layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(2, 2, 1.0)});
  hand.matrices.emplace_back().name = "pad";
  hand.axes.emplace_back().name = "joint";
  return hand;
}

void readAll(const fs::path& path) {
  constexpr std::size_t kMaxNumbers = 1u << 20;
  const auto source = openTable(path);
  for (std::size_t c = 0; c < source->columns().size() && c < 8; ++c) {
    const TableColumn column = source->columns()[c];
    if (!column.isNumeric) continue;
    const std::size_t chosen[] = {c};
    source->start(chosen, std::nullopt);
    TableRow row;
    std::size_t numbers = 0;
    while (numbers < kMaxNumbers && source->next(row)) {
      if (!row.complete) continue;
      requireTrue(row.values.size() == column.width() && row.states.size() == row.values.size());
      for (std::size_t i = 0; i < row.values.size(); ++i)
        requireTrue(row.states[i] != CellState::kNumber || std::isfinite(row.values[i]));
      numbers += row.values.size() + 1;
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const TableFile file;
  static const HandDescription hand = smallPad();
  // HDF5 is a library's own matter.
  if (size > 0 && data[0] == 0x89) return 0;
  std::ofstream(file.path(), std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    readAll(file.path());
  } catch (const Error&) {
  }
  try {
    const ImportPreview preview = previewImport(file.path(), hand, {});
    requireTrue(preview.problem.empty() || preview.problem.find('\n') == std::string::npos);
    requireTrue(preview.sample.rows <= kPreviewRows);
    requireTrue(preview.sample.frames + preview.sample.refused.total() >= preview.sample.frames);
  } catch (const Error&) {
  }
  try {
    mappingFromJson({reinterpret_cast<const char*>(data), size}, "mapping.json");
  } catch (const Error&) {
  }
  return 0;
}

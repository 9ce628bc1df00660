// What an exported file holds beside the recording itself: where it comes from, and series that
// were computed of its frames (signals, slip). The forms HDF5, MAT and MCAP take them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <palpate/core/result_table.h>
#include <palpate/model/series.h>

namespace palpate {

// Where the content of an exported file comes from. Each text may be empty: not known, or none.
struct Provenance {
  std::string program;       // "palpate 1.2.0"
  std::string sourceFile;    // name of the recording, without its folders
  std::string sourceSha256;  // of its bytes, 64 lower-case hexadecimal digits
  std::string filters;       // the chain as text, as `--filter` takes it
  std::string calibration;   // name of the calibration
  std::string hand;          // name of the hand ("flat_pad_16x16")
  bool operator==(const Provenance&) const = default;
};

// A result table whose first column is `time_us` [us since 1970] and whose others are numbers, read
// once as rows of numbers: a series of a day's frames is never in memory as a whole.
class ExportedSeries {
 public:
  // `numRows`: as many as the table has. Throws std::invalid_argument without a column `time_us`.
  ExportedSeries(std::unique_ptr<ResultTable> table, std::size_t numRows)
      : table_(std::move(table)), numRows_(numRows) {
    const std::vector<ResultColumn>& all = table_->columns();
    if (all.empty() || all[0].name != "time_us" || all[0].kind != CellKind::kInteger)
      throw std::invalid_argument("ExportedSeries: '" + name() +
                                  "' doesn't begin with a column time_us");
    for (std::size_t i = 1; i < all.size(); ++i) columns_.push_back({all[i].name, all[i].unit});
  }
  // The group it belongs to: "signals", "slip".
  const std::string& name() const noexcept { return table_->name(); }
  const std::vector<Column>& columns() const noexcept { return columns_; }  // after `time_us`
  std::size_t numRows() const noexcept { return numRows_; }
  // Reads the next row: its time [us since 1970] and a value per column; a value that is not known
  // is NaN. Returns false after the last row. Throws FileError where the frames can't be read.
  bool next(std::int64_t& timeUs, std::span<double> values) {
    if (!table_->next(cells_)) return false;
    timeUs = std::get<std::int64_t>(cells_[0]);
    for (std::size_t i = 0; i < columns_.size(); ++i) values[i] = numberOf(cells_[i + 1]);
    return true;
  }

 private:
  std::unique_ptr<ResultTable> table_;
  std::size_t numRows_;
  std::vector<Column> columns_;
  std::vector<Cell> cells_;
};

// Everything an export writes beside frames, angles, temperatures and events.
struct ExportExtras {
  Provenance provenance;
  std::vector<std::unique_ptr<ExportedSeries>> series;
};

}  // namespace palpate

// What an exported file holds beside the recording itself: where it comes from, and series that
// were computed of its frames (signals, slip). The forms HDF5, MAT and MCAP take them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

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

// A table with a row per frame that is read once, from its first row to its last, so that a series
// of a day's frames is never in memory as a whole.
class ExportedSeries {
 public:
  virtual ~ExportedSeries() = default;
  // The group it belongs to: "signals", "slip".
  virtual const std::string& name() const = 0;
  virtual const std::vector<Column>& columns() const = 0;
  virtual std::size_t numRows() const = 0;
  // Reads the next row: its time [us since 1970] and a value per column; a value that is not known
  // is NaN. Returns false after the last row. Throws FileError where the frames can't be read.
  virtual bool next(std::int64_t& timeUs, std::span<double> values) = 0;
};

// Everything an export writes beside frames, angles, temperatures and events.
struct ExportExtras {
  Provenance provenance;
  std::vector<std::unique_ptr<ExportedSeries>> series;
};

}  // namespace palpate

// The names of groups, data sets and attributes in an HDF5 file of a recording
// (docs/notes/exchange_formats.md), which writer and reader agree on. Private to this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "palpate/recording/hdf5_recording.h"

namespace palpate::hdf5_layout {

constexpr const char* kFormat = "palpate";             // value of the attribute `format`
constexpr const char* kTableFormat = "palpate table";  // the same of a result table
constexpr std::int64_t kUnfilteredLayoutVersion = 1;
constexpr std::int64_t kFilteredLayoutVersion = 2;
constexpr std::int64_t kSeriesLayoutVersion = 3;
constexpr std::int64_t kNoDeviceTime = std::numeric_limits<std::int64_t>::min();
constexpr std::int32_t kNoMatrix = std::numeric_limits<std::int32_t>::min();
// Cells of a result table that aren't known.
constexpr std::int64_t kUnknownInteger = std::numeric_limits<std::int64_t>::min();
constexpr std::uint8_t kUnknownFlag = 255;

// HDF5 leaves the first bytes of a file to the program that writes it (user block). They hold a
// checksum of all bytes behind them, because the library is not safe against a damaged file.
constexpr std::size_t kUserBlockBytes = 512;
inline std::string userBlock(const std::string& sha256OfTheRest) {
  std::string block(kHdf5RecordingStart);
  block += "SHA-256 of the bytes from 512 on:\n" + sha256OfTheRest + "\n";
  block.resize(kUserBlockBytes, '\0');
  return block;
}

// The group of a series, and its array of values.
inline std::string seriesGroup(std::size_t series, const std::string& name) {
  return series == kAngleSeries         ? "joints"
         : series == kTemperatureSeries ? "temperatures"
                                        : "series/" + name;
}
inline const char* seriesValues(std::size_t series) {
  return series == kAngleSeries ? "angles" : "values";
}
// Attribute of the group `series`: the names of further series in their order, with commas between.
constexpr const char* kSeriesNames = "names";

inline std::string matrixPath(std::size_t matrix) { return "tactile/m" + std::to_string(matrix); }
// What the sensor sent, of recordings with readings; the group `tactile` then has the attribute
// kTouchRulesKey.
inline std::string readingsPath(std::size_t matrix) { return matrixPath(matrix) + "_readings"; }

}  // namespace palpate::hdf5_layout

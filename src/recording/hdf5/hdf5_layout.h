// The names of groups, data sets and attributes in an HDF5 file of a recording (docs/bridges.md),
// which writer and reader agree on. Private to this module.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace palpate::hdf5_layout {

constexpr const char* kFormat = "palpate";  // value of the attribute `format`
constexpr std::int64_t kNoDeviceTime = std::numeric_limits<std::int64_t>::min();
constexpr std::int32_t kNoMatrix = std::numeric_limits<std::int32_t>::min();

inline std::string matrixPath(std::size_t matrix) { return "tactile/m" + std::to_string(matrix); }

}  // namespace palpate::hdf5_layout

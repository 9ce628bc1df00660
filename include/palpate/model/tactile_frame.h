// A tactile frame: the values of all taxels at one instant.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <palpate/model/matrix_layout.h>

namespace palpate {

// rows x columns, stored row by row as the sensor sends them. Row 0 is the fingertip.
using MatrixValues = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using MatrixMap = Eigen::Map<MatrixValues>;
using ConstMatrixMap = Eigen::Map<const MatrixValues>;

struct TactileFrame {
  std::shared_ptr<const SensorLayout> layout;
  std::optional<std::int64_t> deviceMs;  // controller's clock, unwrapped [ms]; absent in .dsa
  std::int64_t hostUs = 0;               // host time [us since 1970]
  std::vector<float> values;  // layout->numPlaces() values: counts, or what a filter made

  TactileFrame() = default;
  // All zero.
  explicit TactileFrame(std::shared_ptr<const SensorLayout> sensorLayout);

  // Views of one matrix; valid as long as `values`. Throws std::out_of_range.
  ConstMatrixMap matrix(std::size_t index) const;
  MatrixMap matrix(std::size_t index);
  // Whether every value is a whole number of counts, 0..maxCounts.
  bool isCounts(float maxCounts = 4095.0F) const noexcept;
};

}  // namespace palpate

// A tactile frame: the values of all taxels at one instant.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
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
  // layout->numCells() values. A taxel is active (touched) where its value is above 0; nothing
  // else says so. Counts as they came, or what filters made of them: then a taxel that was not
  // active as recorded has 0, because the tail that a filter over time leaves behind, and what a
  // filter over space gives to neighbours, is no contact.
  std::vector<float> values;
  // What the filters gave to every taxel, the ones that were not active as recorded included: to
  // draw, to keep in a file, to go on filtering. Empty: `values` is all there is.
  std::vector<float> filtered;

  TactileFrame() = default;
  // All zero.
  explicit TactileFrame(std::shared_ptr<const SensorLayout> sensorLayout);

  // Views of one matrix; valid as long as `values`. Throws std::out_of_range.
  ConstMatrixMap matrix(std::size_t index) const;
  MatrixMap matrix(std::size_t index);
  // `filtered`, or `values` where that is empty; of all matrices, or a view of one. Throws
  // std::out_of_range.
  const std::vector<float>& allValues() const noexcept {
    return filtered.empty() ? values : filtered;
  }
  ConstMatrixMap allValues(std::size_t index) const;
  // `all` becomes what the filters gave: kept whole in `filtered`, and in `values` where `active`
  // is set. Throws std::invalid_argument for other lengths than the layout's.
  void setFiltered(std::vector<float> all, const std::vector<bool>& active);
  // Whether every value is a whole number of counts, 0..maxCounts.
  bool isCounts(float maxCounts = 4095.0F) const noexcept;
};

}  // namespace palpate

#include "palpate/model/tactile_frame.h"

#include <algorithm>
#include <stdexcept>

namespace palpate {

TactileFrame::TactileFrame(std::shared_ptr<const SensorLayout> sensorLayout)
    : layout(std::move(sensorLayout)), values(layout->numCells(), 0.0F) {
  if (layout->decidesTouch()) readings.resize(layout->numReadings());
}

ConstMatrixMap TactileFrame::matrix(std::size_t index) const {
  const MatrixLayout& shape = layout->matrix(index);
  return {values.data() + layout->offset(index), shape.rows, shape.columns};
}

MatrixMap TactileFrame::matrix(std::size_t index) {
  const MatrixLayout& shape = layout->matrix(index);
  return {values.data() + layout->offset(index), shape.rows, shape.columns};
}

ConstMatrixMap TactileFrame::allValues(std::size_t index) const {
  const MatrixLayout& shape = layout->matrix(index);
  return {allValues().data() + layout->offset(index), shape.rows, shape.columns};
}

void TactileFrame::setFiltered(std::vector<float> all, const std::vector<bool>& active) {
  if (all.size() != layout->numCells() || active.size() != all.size())
    throw std::invalid_argument("TactileFrame: " + std::to_string(all.size()) + " values and " +
                                std::to_string(active.size()) + " marks for " +
                                std::to_string(layout->numCells()) + " places");
  filtered.clear();
  readings.clear();
  baseline.reset();
  bool same = true;
  for (std::size_t i = 0; i < all.size() && same; ++i) same = active[i] || all[i] == 0.0F;
  if (!same) filtered = all;
  values = std::move(all);
  if (same) return;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!active[i]) values[i] = 0.0F;
}

bool TactileFrame::isCounts(float maxCounts) const noexcept {
  return std::all_of(values.begin(), values.end(), [&](float value) {
    return value >= 0.0F && value <= maxCounts &&
           value == static_cast<float>(static_cast<int>(value));
  });
}

TaxelPeak taxelPeak(const TactileFrame& frame) {
  TaxelPeak largest;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m)
    if (const TaxelPeak peak = taxelPeak(frame, m); peak.counts > largest.counts) largest = peak;
  return largest;
}

TaxelPeak taxelPeak(const TactileFrame& frame, std::size_t matrix) {
  TaxelPeak peak{.matrix = matrix};
  const ConstMatrixMap values = frame.matrix(matrix);
  for (Eigen::Index row = 0; row < values.rows(); ++row)
    for (Eigen::Index column = 0; column < values.cols(); ++column)
      if (values(row, column) > peak.counts)
        peak = {matrix, static_cast<int>(row), static_cast<int>(column), values(row, column)};
  return peak;
}

}  // namespace palpate

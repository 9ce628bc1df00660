#include "palpate/model/tactile_frame.h"

#include <algorithm>

namespace palpate {

TactileFrame::TactileFrame(std::shared_ptr<const SensorLayout> sensorLayout)
    : layout(std::move(sensorLayout)), values(layout->numPlaces(), 0.0F) {}

ConstMatrixMap TactileFrame::matrix(std::size_t index) const {
  const MatrixLayout& shape = layout->matrix(index);
  return {values.data() + layout->offset(index), shape.rows, shape.columns};
}

MatrixMap TactileFrame::matrix(std::size_t index) {
  const MatrixLayout& shape = layout->matrix(index);
  return {values.data() + layout->offset(index), shape.rows, shape.columns};
}

bool TactileFrame::isCounts(float maxCounts) const noexcept {
  return std::all_of(values.begin(), values.end(), [&](float value) {
    return value >= 0.0F && value <= maxCounts &&
           value == static_cast<float>(static_cast<int>(value));
  });
}

}  // namespace palpate

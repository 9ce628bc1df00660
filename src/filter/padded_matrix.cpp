#include "filter/padded_matrix.h"

#include <algorithm>

#include "filter/lanes.h"

namespace palpate::detail {
namespace {

// Copies rows in steps of four values, which is faster for short rows than a call per row. Up to
// three values beyond the end of a row are copied and then overwritten by the next row; the last
// row is copied exactly.
inline void copyRows(
    const float* from, int fromStride, float* to, int toStride, int rows, int columns) {
  if (columns >= kFour) {
    for (; rows > 1; --rows, from += fromStride, to += toStride)
      for (int i = 0; i < columns; i += kFour) store(to + i, loadFour(from + i));
  }
  for (; rows > 0; --rows, from += fromStride, to += toStride)
    for (int i = 0; i < columns; ++i) to[i] = from[i];
}

}  // namespace

PaddedMatrix::PaddedMatrix(const MatrixLayout& layout, int radius)
    : layout_(layout), radius_(radius) {
  const int blocks = (layout.columns + kLanes - 1) / kLanes;
  stride_ = blocks * kLanes + 2 * radius;
  // A block may begin at the last column and row, shifted by the radius.
  values_.assign(static_cast<std::size_t>((layout.rows + 2 * radius) * stride_ + kLanes), 0.0F);
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x)
      if (!layout.enabled(y, x))
        masked_.push_back(
            {static_cast<std::size_t>(at(y, x)), static_cast<std::size_t>(y * layout.columns + x)});
}

void PaddedMatrix::fill(const float* values, float maskedValue) {
  const int rows = layout_.rows;
  const int columns = layout_.columns;
  float* origin = values_.data() + at(0, 0);
  copyRows(values, columns, origin, stride_, rows, columns);
  for (const MaskedPlace& masked : masked_) values_[masked.padded] = maskedValue;
  for (int y = 0; y < rows; ++y) {
    float* row = origin + y * stride_;
    for (int x = 1; x <= radius_; ++x) {
      row[-x] = row[0];
      row[columns - 1 + x] = row[columns - 1];
    }
  }
  const float* first = values_.data() + at(0, -radius_);
  const float* last = values_.data() + at(rows - 1, -radius_);
  for (int y = 1; y <= radius_; ++y) {
    std::copy(first, first + stride_, values_.data() + at(-y, -radius_));
    std::copy(last, last + stride_, values_.data() + at(rows - 1 + y, -radius_));
  }
}

void PaddedMatrix::writeBack(std::vector<float>& plane, float* values) const {
  for (const MaskedPlace& masked : masked_) plane[masked.padded] = values[masked.place];
  copyRows(
      plane.data() + at(0, 0), stride_, values, layout_.columns, layout_.rows, layout_.columns);
}

std::vector<float> PaddedMatrix::onPlane() const {
  PaddedMatrix plane(layout_, radius_);
  plane.fill(std::vector<float>(layout_.numCells(), 1.0F).data(), 0.0F);
  return plane.values_;
}

}  // namespace palpate::detail

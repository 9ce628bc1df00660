#include "filter/spatial_filter.h"

#include <algorithm>

namespace palpate::detail {

bool worksOn(const FilterStep& step, std::size_t matrix) {
  return step.matrices.empty() ||
         std::binary_search(step.matrices.begin(), step.matrices.end(), matrix);
}

std::vector<std::size_t> placesOf(const FilterStep& step, const SensorLayout& layout) {
  std::vector<std::size_t> places;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    if (!worksOn(step, m)) continue;
    const MatrixLayout& matrix = layout.matrix(m);
    for (int y = 0; y < matrix.rows; ++y)
      for (int x = 0; x < matrix.columns; ++x)
        if (matrix.enabled(y, x))
          places.push_back(layout.offset(m) + static_cast<std::size_t>(y * matrix.columns + x));
  }
  return places;
}

bool allZero(const float* values, std::size_t count) {
  // No early exit, so that the compiler vectorises the loop.
  unsigned any = 0;
  for (std::size_t i = 0; i < count; ++i) any |= values[i] != 0.0F ? 1U : 0U;
  return any == 0;
}

void keepOriginal(const float* original, float* values, const MatrixLayout& layout) {
  const std::size_t count = layout.numCells();
  for (std::size_t i = 0; i < count; ++i) values[i] = isTouched(values[i]) ? original[i] : 0.0F;
}

SpatialFilter::SpatialFilter(const FilterStep& step,
                             std::shared_ptr<const SensorLayout> layout,
                             const MakeKernel& make)
    : layout_(std::move(layout)), masked_(step.valueOrZero("masked") != 0.0) {
  for (std::size_t m = 0; m < layout_->numMatrices(); ++m)
    kernels_.push_back(worksOn(step, m) ? make(m) : nullptr);
}

void SpatialFilter::push(TactileFrame& frame, FrameSink& out) {
  for (std::size_t m = 0; m < kernels_.size(); ++m) {
    const MatrixLayout& layout = layout_->matrix(m);
    float* values = frame.values.data() + layout_->offset(m);
    const std::size_t count = layout.numCells();
    if (!kernels_[m] || allZero(values, count)) continue;
    if (masked_) original_.assign(values, values + count);
    kernels_[m]->apply(values);
    if (masked_) keepOriginal(original_.data(), values, layout);
  }
  out.take(frame);
}

}  // namespace palpate::detail

// Computes medians over neighbours in space and time, for the filter "median3d".
#pragma once

#include <memory>
#include <span>

#include "palpate/model/matrix_layout.h"

namespace palpate::detail {

class FramesMedian {
 public:
  virtual ~FramesMedian() = default;
  // Computes the median from the values of one matrix in several frames, and writes the enabled
  // taxels to `values`.
  virtual void apply(std::span<const float* const> frames, float* values) = 0;
};

// Makes a median for exactly `depth` frames.
std::unique_ptr<FramesMedian> framesMedian(const MatrixLayout& layout, int size, int depth);

}  // namespace palpate::detail

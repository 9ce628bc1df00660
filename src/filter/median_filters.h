// Median of the neighbours in space and time.
#pragma once

#include <memory>
#include <span>

#include "palpate/model/matrix_layout.h"

namespace palpate::detail {

class FramesMedian {
 public:
  virtual ~FramesMedian() = default;
  // Of the values of one matrix in several frames; writes the enabled taxels.
  virtual void apply(std::span<const float* const> frames, float* values) = 0;
};

// For exactly `depth` frames.
std::unique_ptr<FramesMedian> framesMedian(const MatrixLayout& layout, int size, int depth);

}  // namespace palpate::detail

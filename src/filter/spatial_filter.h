// What the spatial filters share: a kernel per matrix, empty matrices passed by, the original where
// `masked` asks for it.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "palpate/filter/frame_filter.h"

namespace palpate::detail {

// Filters one matrix in place; masked taxels are neither read nor written. A matrix of zeros must
// stay one.
class MatrixKernel {
 public:
  virtual ~MatrixKernel() = default;
  virtual void apply(float* values) = 0;
};

// Replaces what lies in `values` by the original where it is above 0, else by 0; enabled taxels
// only.
void keepOriginal(const float* original, float* values, const MatrixLayout& layout);
bool allZero(const float* values, std::size_t count);

class SpatialFilter final : public FrameFilter {
 public:
  using MakeKernel = std::function<std::unique_ptr<MatrixKernel>(const MatrixLayout&)>;
  SpatialFilter(const FilterStep& step,
                std::shared_ptr<const SensorLayout> layout,
                const MakeKernel& make);
  void push(TactileFrame& frame, FrameSink& out) override;
  void finish(FrameSink&) override {}

 private:
  const std::shared_ptr<const SensorLayout> layout_;
  const bool masked_;
  std::vector<std::unique_ptr<MatrixKernel>> kernels_;  // null: this matrix is left as it is
  std::vector<float> original_;
};

// The kernels.
std::unique_ptr<MatrixKernel> boxKernel(const MatrixLayout& layout, const FilterStep& step);
std::unique_ptr<MatrixKernel> gaussianKernel(const MatrixLayout& layout, const FilterStep& step);
std::unique_ptr<MatrixKernel> medianKernel(const MatrixLayout& layout, int size);
std::unique_ptr<MatrixKernel> bilateralKernel(const MatrixLayout& layout, const FilterStep& step);
std::unique_ptr<MatrixKernel> nonLocalMeansKernel(const MatrixLayout& layout,
                                                  const FilterStep& step);
std::unique_ptr<MatrixKernel> openingKernel(const MatrixLayout& layout, const FilterStep& step);

// Whether a step works on a matrix.
bool worksOn(const FilterStep& step, std::size_t matrix);
// Where the enabled taxels of those matrices are among the values of a frame.
std::vector<std::size_t> placesOf(const FilterStep& step, const SensorLayout& layout);

}  // namespace palpate::detail

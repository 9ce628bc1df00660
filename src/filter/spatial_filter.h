// Common part of the spatial filters: one kernel per matrix, empty matrices are skipped, and the
// original values are restored where the option `masked` asks for it.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "palpate/filter/frame_filter.h"

namespace palpate::detail {

// Filters one matrix in place; masked taxels are neither read nor written. A matrix of zeros must
// stay zero.
class MatrixKernel {
 public:
  virtual ~MatrixKernel() = default;
  virtual void apply(float* values) = 0;
};

// Replaces each of the `values` by the original where it is above 0, otherwise by 0.
void keepOriginal(const float* original, float* values, const MatrixLayout& layout);
bool allZero(const float* values, std::size_t count);

class SpatialFilter final : public FrameFilter {
 public:
  using MakeKernel = std::function<std::unique_ptr<MatrixKernel>(std::size_t matrix)>;
  SpatialFilter(const FilterStep& step,
                std::shared_ptr<const SensorLayout> layout,
                const MakeKernel& make);
  void push(TactileFrame& frame, FrameSink& out) override;
  void finish(FrameSink&) override {}

 private:
  const std::shared_ptr<const SensorLayout> layout_;
  const bool masked_;
  std::vector<std::unique_ptr<MatrixKernel>>
      kernels_;  // null: the step leaves this matrix unchanged
  std::vector<float> original_;
};

// Make the kernels of the spatial filters.
std::unique_ptr<MatrixKernel> boxKernel(const MatrixLayout& layout, const FilterStep& step);
std::unique_ptr<MatrixKernel> gaussianKernel(const MatrixLayout& layout, const FilterStep& step);
std::unique_ptr<MatrixKernel> medianKernel(const MatrixLayout& layout, int size);
std::unique_ptr<MatrixKernel> bilateralKernel(const MatrixLayout& layout, const FilterStep& step);
std::unique_ptr<MatrixKernel> nonLocalMeansKernel(const MatrixLayout& layout,
                                                  const FilterStep& step);
std::unique_ptr<MatrixKernel> openingKernel(const MatrixLayout& layout, const FilterStep& step);
std::unique_ptr<MatrixKernel> thresholdKernel(const MatrixLayout& layout, const FilterStep& step);
// `offset`: of the matrix among the values of a frame. Throws std::invalid_argument without a rest.
std::unique_ptr<MatrixKernel> baselineKernel(const MatrixLayout& layout,
                                             std::size_t offset,
                                             const FilterStep& step);

// Returns whether a step applies to a matrix.
bool worksOn(const FilterStep& step, std::size_t matrix);
// Indices of the enabled taxels of the step's matrices among the values of a frame.
std::vector<std::size_t> placesOf(const FilterStep& step, const SensorLayout& layout);

}  // namespace palpate::detail

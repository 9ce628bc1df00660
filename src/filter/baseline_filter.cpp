// Kernel of the filter "baseline": what exceeds the rest by more than its noise.
#include <algorithm>
#include <stdexcept>

#include "filter/spatial_filter.h"

namespace palpate::detail {
namespace {

class BaselineKernel final : public MatrixKernel {
 public:
  BaselineKernel(std::vector<float> rest, std::vector<float> limits)
      : rest_(std::move(rest)), limits_(std::move(limits)) {}

  void apply(float* values) override {
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      const float over = values[i] - rest_[i];
      values[i] = over > limits_[i] ? over : 0.0F;
    }
  }

 private:
  const std::vector<float> rest_, limits_;  // per place
};

}  // namespace

std::unique_ptr<MatrixKernel> baselineKernel(const MatrixLayout& layout,
                                             std::size_t offset,
                                             const FilterStep& step) {
  if (!step.rest)
    throw std::invalid_argument(
        "baseline: the readings at rest are taken of a recording, or live with Baseline");
  const Baseline& all = *step.rest;
  const auto above = static_cast<float>(step.value("above"));
  const auto sigmas = static_cast<float>(step.value("sigmas"));
  std::vector<float> rest(layout.numCells(), 0.0F), limits(layout.numCells(), above);
  // Masked places are neither read nor written: they are 0.
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (layout.staticMask[i] == 0) continue;
    rest[i] = all.rest[offset + i];
    if (!all.noise.empty()) limits[i] = std::max(above, sigmas * all.noise[offset + i]);
  }
  return std::make_unique<BaselineKernel>(std::move(rest), std::move(limits));
}

}  // namespace palpate::detail

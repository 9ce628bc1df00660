// Kernel of the filter "threshold": values up to it become 0.
#include "filter/spatial_filter.h"

namespace palpate::detail {
namespace {

class ThresholdKernel final : public MatrixKernel {
 public:
  ThresholdKernel(std::size_t count, float above) : count_(count), above_(above) {}

  void apply(float* values) override {
    for (std::size_t i = 0; i < count_; ++i) values[i] = values[i] > above_ ? values[i] : 0.0F;
  }

 private:
  std::size_t count_;
  float above_;
};

}  // namespace

std::unique_ptr<MatrixKernel> thresholdKernel(const MatrixLayout& layout, const FilterStep& step) {
  return std::make_unique<ThresholdKernel>(layout.numCells(),
                                           static_cast<float>(step.value("above")));
}

}  // namespace palpate::detail

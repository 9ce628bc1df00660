// Kernel of the filter "bilateral" (Tomasi and Manduchi 1998): the neighbours within a round
// window, weighted by distance and by difference of value.
#include "filter/lanes.h"
#include "filter/padded_matrix.h"
#include "filter/pair_weights.h"
#include "filter/spatial_filter.h"

namespace palpate::detail {
namespace {

class BilateralKernel final : public MatrixKernel {
 public:
  BilateralKernel(const MatrixLayout& layout, int diameter, double sigmaValue, double sigmaSpace)
      : padded_(layout, diameter / 2),
        weights_(padded_,
                 diameter / 2,
                 [radius = diameter / 2](int dy, int dx) {
                   return dx * dx + dy * dy <= radius * radius;
                 }),
        out_(padded_.size(), 0.0F),
        valueFactor_(static_cast<float>(-0.5 / (sigmaValue * sigmaValue))),
        spaceFactor_(-0.5 / (sigmaSpace * sigmaSpace)) {}

  void apply(float* values) override {
    padded_.fill(values, 0.0F);
    for (const PairWeights::Step& step : weights_.steps()) {
      const float* at = padded_.data();
      const auto ofDistance =
          static_cast<float>(spaceFactor_ * (step.dx * step.dx + step.dy * step.dy));
      weights_.setExponents(
          step,
          [&](int i, int) -> Lanes {
            const Lanes difference = load(at + i + step.inPadded) - load(at + i);
            return difference * difference * valueFactor_ + ofDistance;
          },
          padded_);
    }
    weights_.average(padded_, out_);
    padded_.writeBack(out_, values);
  }

 private:
  PaddedMatrix padded_;
  PairWeights weights_;
  std::vector<float> out_;
  float valueFactor_ = 0.0F;
  double spaceFactor_ = 0.0;
};

}  // namespace

std::unique_ptr<MatrixKernel> bilateralKernel(const MatrixLayout& layout, const FilterStep& step) {
  return std::make_unique<BilateralKernel>(
      layout, step.integer("diameter"), step.value("sigma_value"), step.value("sigma_space"));
}

}  // namespace palpate::detail

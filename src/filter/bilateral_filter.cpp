// Kernel of the filter "bilateral" (Tomasi and Manduchi 1998): the neighbours within a round
// window, weighted by distance and by difference of value.
#include <cmath>

#include "filter/lanes.h"
#include "filter/padded_matrix.h"
#include "filter/spatial_filter.h"

namespace palpate::detail {
namespace {

class BilateralKernel final : public MatrixKernel {
 public:
  BilateralKernel(const MatrixLayout& layout, int diameter, double sigmaValue, double sigmaSpace)
      : padded_(layout, diameter / 2),
        on_(padded_.onPlane()),
        out_(padded_.size(), 0.0F),
        valueFactor_(static_cast<float>(-0.5 / (sigmaValue * sigmaValue))) {
    const int radius = diameter / 2;
    for (int dy = -radius; dy <= radius; ++dy) {
      for (int dx = -radius; dx <= radius; ++dx) {
        const int squared = dx * dx + dy * dy;
        if (squared == 0 || squared > radius * radius) continue;
        neighbors_.push_back({dy * padded_.stride() + dx,
                              static_cast<float>(-0.5 * squared / (sigmaSpace * sigmaSpace))});
      }
    }
  }

  void apply(float* values) override {
    padded_.fill(values, 0.0F);
    for (int y = 0; y < padded_.rows(); ++y) {
      for (int x = 0; x < padded_.columns(); x += kLanes) {
        const int i = padded_.at(y, x);
        const float* at = padded_.data() + i;
        const float* on = on_.data() + i;
        const Lanes own = load(at);
        Lanes sum = own;
        Lanes total = Lanes::Ones();
        for (const Neighbor& neighbor : neighbors_) {
          const Lanes value = load(at + neighbor.step);
          const Lanes difference = value - own;
          const Lanes weight = load(on + neighbor.step) *
                               expOf(difference * difference * valueFactor_ + neighbor.exponent);
          sum += weight * value;
          total += weight;
        }
        store(out_.data() + i, sum / total);
      }
    }
    padded_.writeBack(out_, values);
  }

 private:
  struct Neighbor {
    int step;        // in the padded matrix
    float exponent;  // of the distance's weight
  };
  PaddedMatrix padded_;
  std::vector<float> on_;
  std::vector<float> out_;
  std::vector<Neighbor> neighbors_;
  float valueFactor_ = 0.0F;
};

}  // namespace

std::unique_ptr<MatrixKernel> bilateralKernel(const MatrixLayout& layout, const FilterStep& step) {
  return std::make_unique<BilateralKernel>(
      layout, step.integer("diameter"), step.value("sigma_value"), step.value("sigma_space"));
}

}  // namespace palpate::detail

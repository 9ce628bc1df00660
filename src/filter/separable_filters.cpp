// Kernels of the filters "box" and "gaussian": the same weights along both directions.
#include <algorithm>
#include <cmath>

#include "palpate/filter/gaussian.h"

#include "filter/lanes.h"
#include "filter/padded_matrix.h"
#include "filter/spatial_filter.h"

namespace palpate::detail {
namespace {

class SeparableKernel final : public MatrixKernel {
 public:
  SeparableKernel(const MatrixLayout& layout, std::vector<float> weights)
      : padded_(layout, static_cast<int>(weights.size()) / 2),
        weights_(std::move(weights)),
        alongX_(padded_.size(), 0.0F),
        out_(padded_.size(), 0.0F) {
    if (!padded_.hasMasked()) return;
    total_.assign(padded_.size(), 1.0F);
    const std::vector<float> on = padded_.onPlane();
    convolve(on.data(), total_.data());
    // Far from all enabled taxels the total weight is 0; avoid a division by it.
    for (float& total : total_) total = total > 0.0F ? total : 1.0F;
  }

  void apply(float* values) override {
    padded_.fill(values, 0.0F);
    convolve(padded_.data(), out_.data());
    if (padded_.hasMasked()) {
      // The weights of masked taxels are distributed to the others.
      for (int y = 0; y < padded_.rows(); ++y) {
        for (int x = 0; x < padded_.columns(); x += kLanes) {
          const int i = padded_.at(y, x);
          store(out_.data() + i, load(out_.data() + i) / load(total_.data() + i));
        }
      }
    }
    padded_.writeBack(out_, values);
  }

 private:
  void convolve(const float* in, float* out) {
    const int radius = padded_.radius();
    for (int y = -radius; y < padded_.rows() + radius; ++y) {
      for (int x = 0; x < padded_.columns(); x += kLanes) {
        const int i = padded_.at(y, x);
        store(alongX_.data() + i, weighted(in + i - radius, 1));
      }
    }
    for (int y = 0; y < padded_.rows(); ++y) {
      for (int x = 0; x < padded_.columns(); x += kLanes) {
        const int i = padded_.at(y, x);
        store(out + i, weighted(alongX_.data() + i - radius * padded_.stride(), padded_.stride()));
      }
    }
  }

  Lanes weighted(const float* from, int step) const {
    Lanes sum = Lanes::Zero();
    for (std::size_t k = 0; k < weights_.size(); ++k)
      sum += weights_[k] * load(from + static_cast<int>(k) * step);
    return sum;
  }

  PaddedMatrix padded_;
  const std::vector<float> weights_;
  std::vector<float> alongX_;
  std::vector<float> out_;
  std::vector<float> total_;  // weight of the existing taxels; empty when none is masked
};

}  // namespace

std::unique_ptr<MatrixKernel> boxKernel(const MatrixLayout& layout, const FilterStep& step) {
  const auto size = static_cast<std::size_t>(step.integer("size"));
  return std::make_unique<SeparableKernel>(
      layout, std::vector<float>(size, 1.0F / static_cast<float>(size)));
}

std::unique_ptr<MatrixKernel> gaussianKernel(const MatrixLayout& layout, const FilterStep& step) {
  GaussianOptions options{.size = step.integer("size")};
  if (!std::isnan(step.value("sigma"))) options.sigma = step.value("sigma");
  return std::make_unique<SeparableKernel>(layout, gaussianWeights(options));
}

}  // namespace palpate::detail

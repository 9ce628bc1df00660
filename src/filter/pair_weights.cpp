#include "filter/pair_weights.h"

#include <algorithm>

namespace palpate::detail {
namespace {

// A smaller exponent counts as this one: its exp() would be a denormal number, which makes the
// bilateral filter nine times slower.
constexpr float kMinExponent = -87.0F;
// The exponent of a pair with a masked taxel. Its weight, exp(-87), is lost in the total, which is
// 1 and above, and in the sum it is multiplied by 0, the masked taxel's value in the padded matrix.
constexpr float kExcluded = -1e30F;

}  // namespace

void PairWeights::addStep(const PaddedMatrix& padded, int dy, int dx) {
  Step step;
  step.dy = dy;
  step.dx = dx;
  step.inPadded = dy * padded.stride() + dx;
  step.firstColumn = std::min(0, -dx);
  const int entries = columns_ + std::abs(dx);
  step.width = (entries + kLanes - 1) / kLanes * kLanes;
  step.begin = static_cast<int>(weights_.size());
  weights_.resize(weights_.size() + static_cast<std::size_t>((rows_ + dy) * step.width));
  steps_.push_back(step);
}

void PairWeights::exclude(const PaddedMatrix& padded) {
  // A block of a shifted row may read beyond its end.
  weights_.resize(weights_.size() + kLanes);
  excluded_.assign(weights_.size(), 0.0F);
  const std::vector<float> on = padded.onPlane();
  for (const Step& step : steps_) {
    for (int y = -step.dy; y < rows_; ++y) {
      for (int x = step.firstColumn; x < columns_ + std::max(0, -step.dx); ++x) {
        const auto i = static_cast<std::size_t>(padded.at(y, x));
        const auto other = static_cast<std::size_t>(padded.at(y, x) + step.inPadded);
        if (on[i] * on[other] == 0.0F)
          excluded_[static_cast<std::size_t>(step.at(y, x))] = kExcluded;
      }
    }
  }
}

void PairWeights::average(const PaddedMatrix& padded, std::vector<float>& out) {
  Eigen::Map<Eigen::ArrayXf> all(weights_.data(), static_cast<Eigen::Index>(weights_.size()));
  all = all.max(kMinExponent).exp();
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; x += kLanes) {
      const float* value = padded.data() + padded.at(y, x);
      Lanes sum = load(value);
      Lanes total = Lanes::Ones();
      for (const Step& step : steps_) {
        const Lanes below = load(weights_.data() + step.at(y, x));
        const Lanes above = load(weights_.data() + step.at(y - step.dy, x - step.dx));
        sum += below * load(value + step.inPadded) + above * load(value - step.inPadded);
        total += below + above;
      }
      store(out.data() + padded.at(y, x), sum / total);
    }
  }
}

}  // namespace palpate::detail

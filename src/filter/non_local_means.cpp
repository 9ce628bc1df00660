// Kernel of the filter "nlm" (non-local means; Buades, Coll and Morel 2005): the taxels of the
// neighbourhood, weighted by exp(-d^2 / h^2), where d^2 is the mean squared difference of the
// patches around both taxels.
#include <cmath>

#include "filter/lanes.h"
#include "filter/padded_matrix.h"
#include "filter/spatial_filter.h"

namespace palpate::detail {
namespace {

class NonLocalMeansKernel final : public MatrixKernel {
 public:
  NonLocalMeansKernel(const MatrixLayout& layout, int patch, int search, double h)
      : padded_(layout, patch / 2 + search / 2),
        patchRadius_(patch / 2),
        factor_(static_cast<float>(-1.0 / (h * h))),
        on_(padded_.onPlane()),
        squared_(padded_.size(), 0.0F),
        sum_(padded_.size(), 0.0F),
        total_(padded_.size(), 0.0F) {
    const int radius = search / 2;
    for (int dy = -radius; dy <= radius; ++dy)
      for (int dx = -radius; dx <= radius; ++dx)
        offsets_.push_back({dy * padded_.stride() + dx, perPair(dy * padded_.stride() + dx)});
  }

  void apply(float* values) override {
    padded_.fill(values, 0.0F);
    sum_.assign(sum_.size(), 0.0F);
    total_.assign(total_.size(), 0.0F);
    for (const Offset& offset : offsets_) {
      squareDifferences(offset.step);
      eachBlock([&](int i) {
        const float* other = padded_.data() + i + offset.step;
        const Lanes meanSquare = patchSum(i) * load(offset.perPair.data() + i);
        const Lanes weight = load(on_.data() + i + offset.step) * expOf(meanSquare * factor_);
        store(sum_.data() + i, load(sum_.data() + i) + weight * load(other));
        store(total_.data() + i, load(total_.data() + i) + weight);
      });
    }
    eachBlock(
        [&](int i) { store(sum_.data() + i, load(sum_.data() + i) / load(total_.data() + i)); });
    padded_.writeBack(sum_, values);
  }

 private:
  struct Offset {
    int step;                    // in the padded matrix
    std::vector<float> perPair;  // 1 / number of taxels that exist in both patches
  };

  template <typename Work>
  void eachBlock(const Work& work) {
    for (int y = 0; y < padded_.rows(); ++y)
      for (int x = 0; x < padded_.columns(); x += kLanes) work(padded_.at(y, x));
  }
  // Squared differences of all pairs of taxels `step` apart, over an area that is large enough for
  // the patches.
  void squareDifferences(int step) {
    const float* at = padded_.data();
    for (int y = -patchRadius_; y < padded_.rows() + patchRadius_; ++y) {
      for (int x = -patchRadius_; x < padded_.columns() + patchRadius_; x += kLanes) {
        const int i = padded_.at(y, x);
        const Lanes difference = load(at + i) - load(at + i + step);
        store(squared_.data() + i,
              difference * difference * load(on_.data() + i) * load(on_.data() + i + step));
      }
    }
  }
  Lanes patchSum(int i) const {
    Lanes sum = Lanes::Zero();
    for (int dy = -patchRadius_; dy <= patchRadius_; ++dy)
      for (int dx = -patchRadius_; dx <= patchRadius_; ++dx)
        sum += load(squared_.data() + i + dy * padded_.stride() + dx);
    return sum;
  }
  std::vector<float> perPair(int step) const {
    std::vector<float> result(padded_.size(), 0.0F);
    for (int y = 0; y < padded_.rows(); ++y) {
      for (int x = 0; x < padded_.columns(); ++x) {
        float count = 0.0F;
        for (int dy = -patchRadius_; dy <= patchRadius_; ++dy) {
          for (int dx = -patchRadius_; dx <= patchRadius_; ++dx) {
            const int i = padded_.at(y + dy, x + dx);
            count += on_[static_cast<std::size_t>(i)] * on_[static_cast<std::size_t>(i + step)];
          }
        }
        result[static_cast<std::size_t>(padded_.at(y, x))] = count > 0.0F ? 1.0F / count : 0.0F;
      }
    }
    return result;
  }

  PaddedMatrix padded_;
  int patchRadius_ = 0;
  float factor_ = 0.0F;
  std::vector<float> on_;
  std::vector<float> squared_;
  std::vector<float> sum_;
  std::vector<float> total_;
  std::vector<Offset> offsets_;
};

}  // namespace

std::unique_ptr<MatrixKernel> nonLocalMeansKernel(const MatrixLayout& layout,
                                                  const FilterStep& step) {
  return std::make_unique<NonLocalMeansKernel>(
      layout, step.integer("patch"), step.integer("search"), step.value("h"));
}

}  // namespace palpate::detail

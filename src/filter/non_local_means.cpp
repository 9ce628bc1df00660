// Kernel of the filter "nlm" (non-local means; Buades, Coll and Morel 2005): the taxels of the
// neighbourhood, weighted by exp(-d^2 / h^2), where d^2 is the mean squared difference of the
// patches around both taxels.
#include <algorithm>

#include "filter/lanes.h"
#include "filter/padded_matrix.h"
#include "filter/pair_weights.h"
#include "filter/spatial_filter.h"

namespace palpate::detail {
namespace {

class NonLocalMeansKernel final : public MatrixKernel {
 public:
  NonLocalMeansKernel(const MatrixLayout& layout, int patch, int search, double h)
      : padded_(layout, patch / 2 + search / 2),
        weights_(padded_, search / 2, [](int, int) { return true; }),
        patchRadius_(patch / 2),
        on_(padded_.onPlane()),
        squared_(padded_.size(), 0.0F),
        rowSums_(padded_.size(), 0.0F),
        out_(padded_.size(), 0.0F) {
    for (const PairWeights::Step& step : weights_.steps()) setFactors(step, -1.0 / (h * h));
  }

  void apply(float* values) override {
    padded_.fill(values, 0.0F);
    for (const PairWeights::Step& step : weights_.steps()) {
      sumSquares(step);
      weights_.setExponents(
          step,
          [&](int i, int k) -> Lanes { return patchSum(i) * load(factors_.data() + k); },
          padded_);
    }
    weights_.average(padded_, out_);
    padded_.writeBack(out_, values);
  }

 private:
  using Stretch = Eigen::Map<const Eigen::ArrayXf>;

  // Squared differences of all pairs of taxels, over an area that is large enough for the patches,
  // and their sums over the columns of a patch. They are computed in one stretch, with the places
  // between the rows, since that is faster than row by row.
  void sumSquares(const PairWeights::Step& step) {
    const int right = padded_.columns() - 1 + std::max(0, -step.dx);
    const int begin = padded_.at(-step.dy - patchRadius_, step.firstColumn - patchRadius_);
    const int end = padded_.at(padded_.rows() - 1 + patchRadius_, right + patchRadius_) + 1;
    const auto part = [&](const std::vector<float>& plane, int from, int to) {
      return Stretch(plane.data() + from, to - from);
    };
    const int other = step.inPadded;
    Eigen::Map<Eigen::ArrayXf>(squared_.data() + begin, end - begin) =
        (part(padded_.values(), begin, end) - part(padded_.values(), begin + other, end + other))
            .square() *
        part(on_, begin, end) * part(on_, begin + other, end + other);
    const int first = begin + patchRadius_, last = end - patchRadius_;
    Eigen::Map<Eigen::ArrayXf> sums(rowSums_.data() + first, last - first);
    if (patchRadius_ == 1) {
      sums = part(squared_, first - 1, last - 1) + part(squared_, first, last) +
             part(squared_, first + 1, last + 1);
      return;
    }
    sums = part(squared_, first, last);
    for (int dx = 1; dx <= patchRadius_; ++dx)
      sums += part(squared_, first - dx, last - dx) + part(squared_, first + dx, last + dx);
  }
  Lanes patchSum(int i) const {
    Lanes sum = load(rowSums_.data() + i);
    for (int rows = padded_.stride(); rows <= patchRadius_ * padded_.stride();
         rows += padded_.stride())
      sum += load(rowSums_.data() + i - rows) + load(rowSums_.data() + i + rows);
    return sum;
  }
  // `factor` / number of taxels that exist in both patches.
  void setFactors(const PairWeights::Step& step, double factor) {
    factors_.resize(static_cast<std::size_t>(step.at(padded_.rows(), step.firstColumn)), 0.0F);
    for (int y = -step.dy; y < padded_.rows(); ++y) {
      for (int x = step.firstColumn; x < padded_.columns() + std::max(0, -step.dx); ++x) {
        int count = 0;
        for (int dy = -patchRadius_; dy <= patchRadius_; ++dy) {
          for (int dx = -patchRadius_; dx <= patchRadius_; ++dx) {
            const int i = padded_.at(y + dy, x + dx);
            if (on_[static_cast<std::size_t>(i)] *
                    on_[static_cast<std::size_t>(i + step.inPadded)] >
                0.0F)
              ++count;
          }
        }
        if (count > 0)
          factors_[static_cast<std::size_t>(step.at(y, x))] = static_cast<float>(factor / count);
      }
    }
  }

  PaddedMatrix padded_;
  PairWeights weights_;
  int patchRadius_ = 0;
  std::vector<float> on_;
  std::vector<float> squared_;
  std::vector<float> rowSums_;  // of the squares, over the columns of a patch
  std::vector<float> factors_;  // of the exponents, in the memory order of the weights
  std::vector<float> out_;
};

}  // namespace

std::unique_ptr<MatrixKernel> nonLocalMeansKernel(const MatrixLayout& layout,
                                                  const FilterStep& step) {
  return std::make_unique<NonLocalMeansKernel>(
      layout, step.integer("patch"), step.integer("search"), step.value("h"));
}

}  // namespace palpate::detail

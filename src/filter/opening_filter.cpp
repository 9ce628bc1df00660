// Kernel of the filter "opening" (morphological opening): erosion, then dilation. Masked taxels and
// places outside of the matrix are ignored.
#include <cmath>
#include <limits>

#include "filter/lanes.h"
#include "filter/padded_matrix.h"
#include "filter/spatial_filter.h"

namespace palpate::detail {
namespace {

constexpr float kOpeningFilterInfinity = std::numeric_limits<float>::infinity();

enum Shape { kCross, kRectangle, kEllipse };  // in the order of the catalogue

// Half the width of row dy of the structuring element; negative when the row is empty.
int halfWidth(int shape, int radius, int dy) {
  if (shape == kRectangle) return radius;
  if (shape == kCross) return dy == 0 ? radius : 0;
  // The ellipse of OpenCV's getStructuringElement.
  const double part = radius == 0 ? 0.0 : static_cast<double>(dy) / radius;
  return static_cast<int>(std::lrint(radius * std::sqrt(1.0 - part * part)));
}

class OpeningKernel final : public MatrixKernel {
 public:
  OpeningKernel(const MatrixLayout& layout, int shape, int size)
      : padded_(layout, size / 2), eroded_(layout.numCells(), 0.0F), out_(padded_.size(), 0.0F) {
    const int radius = size / 2;
    for (int dy = -radius; dy <= radius; ++dy) {
      const int half = halfWidth(shape, radius, dy);
      for (int dx = -half; dx <= half; ++dx) element_.push_back(dy * padded_.stride() + dx);
    }
  }

  void apply(float* values) override {
    padded_.fill(values, kOpeningFilterInfinity);
    overElement([](const Lanes& a, const Lanes& b) -> Lanes { return a.min(b); });
    padded_.writeBack(out_, eroded_.data());
    padded_.fill(eroded_.data(), -kOpeningFilterInfinity);
    overElement([](const Lanes& a, const Lanes& b) -> Lanes { return a.max(b); });
    padded_.writeBack(out_, values);
  }

 private:
  template <typename Choose>
  void overElement(const Choose& choose) {
    for (int y = 0; y < padded_.rows(); ++y) {
      for (int x = 0; x < padded_.columns(); x += kLanes) {
        const int i = padded_.at(y, x);
        Lanes chosen = load(padded_.data() + i);
        for (const int step : element_) chosen = choose(chosen, load(padded_.data() + i + step));
        store(out_.data() + i, chosen);
      }
    }
  }

  PaddedMatrix padded_;
  std::vector<float> eroded_;
  std::vector<float> out_;
  std::vector<int> element_;  // steps in the padded matrix
};

}  // namespace

std::unique_ptr<MatrixKernel> openingKernel(const MatrixLayout& layout, const FilterStep& step) {
  return std::make_unique<OpeningKernel>(layout, step.integer("shape"), step.integer("size"));
}

}  // namespace palpate::detail

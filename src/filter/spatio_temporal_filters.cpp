// Filters over space and time: "median3d" and "min-median".
#include <algorithm>

#include "filter/median_filters.h"
#include "filter/spatial_filter.h"
#include "filter/temporal_filters.h"
#include "filter/windowed_filter.h"

namespace palpate::detail {
namespace {

// Median of the neighbours in space and time. Before the first and after the last frame, that frame
// is repeated.
class Median3d final : public WindowedFilter {
 public:
  Median3d(const FilterStep& step, std::shared_ptr<const SensorLayout> layout)
      : WindowedFilter(step.integer("window"), step.flag("centred"), Edge::kShrink),
        layout_(std::move(layout)),
        depth_(step.integer("window")),
        centred_(step.flag("centred")),
        masked_(step.flag("masked")) {
    for (std::size_t m = 0; m < layout_->numMatrices(); ++m)
      medians_.push_back(worksOn(step, m)
                             ? framesMedian(layout_->matrix(m), step.integer("size"), depth_)
                             : nullptr);
  }

 protected:
  void compute(std::span<const float* const> window, std::size_t current, float* values) override {
    const int now = static_cast<int>(current);
    const int first = centred_ ? now - depth_ / 2 : now - depth_ + 1;
    const int last = static_cast<int>(window.size()) - 1;
    for (std::size_t m = 0; m < medians_.size(); ++m) {
      if (!medians_[m]) continue;
      const std::size_t offset = layout_->offset(m);
      const std::size_t count = layout_->matrix(m).numCells();
      frames_.clear();
      bool empty = true;
      for (int i = first; i < first + depth_; ++i) {
        const auto frame = static_cast<std::size_t>(std::clamp(i, 0, last));
        frames_.push_back(window[frame] + offset);
        empty = empty && allZero(frames_.back(), count);
      }
      if (empty) continue;
      medians_[m]->apply(frames_, values + offset);
      if (masked_) keepOriginal(window[current] + offset, values + offset, layout_->matrix(m));
    }
  }

 private:
  const std::shared_ptr<const SensorLayout> layout_;
  const int depth_;
  const bool centred_;
  const bool masked_;
  std::vector<std::unique_ptr<FramesMedian>> medians_;
  std::vector<const float*> frames_;
};

class MinMedian final : public WindowedFilter {
 public:
  MinMedian(const FilterStep& step, std::shared_ptr<const SensorLayout> layout)
      : WindowedFilter(step.integer("window"), step.flag("centred"), Edge::kShrink),
        layout_(std::move(layout)),
        masked_(step.flag("masked")),
        places_(placesOf(step, *layout_)),
        lowest_(layout_->numCells(), 0.0F) {
    for (std::size_t m = 0; m < layout_->numMatrices(); ++m)
      medians_.push_back(worksOn(step, m) ? medianKernel(layout_->matrix(m), step.integer("size"))
                                          : nullptr);
  }

 protected:
  void compute(std::span<const float* const> window, std::size_t current, float* values) override {
    lowest_.assign(window[current], window[current] + lowest_.size());
    for (const float* frame : window)
      for (std::size_t i = 0; i < lowest_.size(); ++i) lowest_[i] = std::min(lowest_[i], frame[i]);
    for (std::size_t m = 0; m < medians_.size(); ++m) {
      float* of = lowest_.data() + layout_->offset(m);
      if (medians_[m] && !allZero(of, layout_->matrix(m).numCells())) medians_[m]->apply(of);
    }
    for (const std::size_t place : places_) {
      if (!masked_)
        values[place] = lowest_[place];
      else if (!isTouched(lowest_[place]))
        values[place] = 0.0F;
    }
  }

 private:
  const std::shared_ptr<const SensorLayout> layout_;
  const bool masked_;
  const std::vector<std::size_t> places_;
  std::vector<float> lowest_;
  std::vector<std::unique_ptr<MatrixKernel>> medians_;
};

}  // namespace

std::unique_ptr<FrameFilter> spatioTemporalFilter(const FilterStep& step,
                                                  std::shared_ptr<const SensorLayout> layout) {
  if (step.name == "median3d") return std::make_unique<Median3d>(step, std::move(layout));
  return std::make_unique<MinMedian>(step, std::move(layout));
}

}  // namespace palpate::detail

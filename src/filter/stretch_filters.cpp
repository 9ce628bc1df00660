// Filters that need a whole stretch of frames before they return the first one.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "palpate/core/error.h"
#include "palpate/core/time.h"
#include "palpate/filter/butterworth.h"
#include "palpate/filter/kalman.h"
#include "palpate/filter/kelvin_voigt_estimation.h"

#include "filter/spatial_filter.h"
#include "filter/temporal_filters.h"

namespace palpate::detail {
namespace {

constexpr std::size_t kMaxValues = std::size_t{1} << 28;  // a gigabyte

// Collects the frames of a stretch, then filters the series of each taxel that was not always 0.
class StretchFilter : public FrameFilter {
 public:
  void push(TactileFrame& frame, FrameSink&) final {
    if ((frames_.size() + 1) * frame.values.size() > kMaxValues)
      throw Error("more than " + std::to_string(frames_.size()) +
                  " frames without a gap are too many for a filter that needs them all at once: "
                  "take a part of the recording");
    frames_.push_back(std::move(frame));
  }

  void finish(FrameSink& out) final {
    std::vector<TactileFrame> frames = std::move(frames_);
    frames_.clear();
    if (!frames.empty()) {
      std::vector<double> timeS;
      for (const TactileFrame& frame : frames)
        timeS.push_back(static_cast<double>(frame.hostUs - frames.front().hostUs) / kUsPerS);
      for (std::size_t m = 0; m < layout_->numMatrices(); ++m)
        if (worksOn(step_, m)) filterMatrix(frames, timeS, m);
    }
    for (TactileFrame& frame : frames) out.take(frame);
  }

 protected:
  StretchFilter(const FilterStep& step, std::shared_ptr<const SensorLayout> layout)
      : step_(step), layout_(std::move(layout)) {}
  // Called before the taxels of each matrix; `strongest` is the series of the taxel with the
  // largest sum.
  virtual void prepare(std::span<const double> timeS, std::span<const double> strongest) = 0;
  virtual std::vector<double> filtered(std::span<const double> timeS,
                                       std::span<const double> series) = 0;

 private:
  std::vector<double> seriesOf(const std::vector<TactileFrame>& frames, std::size_t place) const {
    std::vector<double> series;
    series.reserve(frames.size());
    for (const TactileFrame& frame : frames)
      series.push_back(static_cast<double>(frame.values[place]));
    return series;
  }

  void filterMatrix(std::vector<TactileFrame>& frames,
                    std::span<const double> timeS,
                    std::size_t m) {
    const MatrixLayout& layout = layout_->matrix(m);
    std::vector<double> sums(layout.numCells(), 0.0);
    for (const TactileFrame& frame : frames)
      for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] += std::abs(static_cast<double>(frame.values[layout_->offset(m) + i]));
    const auto strongest = std::max_element(sums.begin(), sums.end());
    if (*strongest == 0.0) return;
    const std::size_t offset = layout_->offset(m);
    prepare(timeS, seriesOf(frames, offset + static_cast<std::size_t>(strongest - sums.begin())));
    for (int y = 0; y < layout.rows; ++y) {
      for (int x = 0; x < layout.columns; ++x) {
        const auto place = static_cast<std::size_t>(y * layout.columns + x);
        if (!layout.enabled(y, x) || sums[place] == 0.0) continue;
        const std::vector<double> result = filtered(timeS, seriesOf(frames, offset + place));
        for (std::size_t i = 0; i < frames.size(); ++i)
          frames[i].values[offset + place] = static_cast<float>(result[i]);
      }
    }
  }

  const FilterStep step_;
  const std::shared_ptr<const SensorLayout> layout_;
  std::vector<TactileFrame> frames_;
};

// Rauch-Tung-Striebel smoother over the zero-order Kalman filter.
class Smoother final : public StretchFilter {
 public:
  Smoother(const FilterStep& step, std::shared_ptr<const SensorLayout> layout)
      : StretchFilter(step, std::move(layout)), options_{step.value("q"), step.value("r")} {}

 protected:
  void prepare(std::span<const double>, std::span<const double>) override {}
  std::vector<double> filtered(std::span<const double>, std::span<const double> series) override {
    return rtsSmoothed(series, options_);
  }

 private:
  const KalmanOptions options_;
};

// A Butterworth filter forwards and backwards.
class ZeroPhase final : public StretchFilter {
 public:
  ZeroPhase(const FilterStep& step, std::shared_ptr<const SensorLayout> layout)
      : StretchFilter(step, std::move(layout)), options_(*butterworthOf(step)) {}

 protected:
  void prepare(std::span<const double>, std::span<const double>) override {}
  std::vector<double> filtered(std::span<const double> timeS,
                               std::span<const double> series) override {
    return butterworthZeroPhase(timeS, series, options_);
  }

 private:
  const ButterworthOptions options_;
};

std::optional<double> givenOf(const FilterStep& step, const char* key) {
  const double value = step.value(key);
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

// Parameters of the model that are not given are estimated once per matrix, from its most loaded
// taxel.
class KelvinVoigt final : public StretchFilter {
 public:
  KelvinVoigt(const FilterStep& step, std::shared_ptr<const SensorLayout> layout)
      : StretchFilter(step, std::move(layout)), smoothed_(step.flag("centred")) {
    known_.mass = givenOf(step, "m").value_or(1.0);
    known_.stiffness = givenOf(step, "e");
    known_.viscosity = givenOf(step, "eta");
    known_.forceNoise = givenOf(step, "q");
    known_.measurementNoise = givenOf(step, "r");
  }

 protected:
  void prepare(std::span<const double> timeS, std::span<const double> strongest) override {
    model_ = estimateKelvinVoigt(timeS, strongest, known_).model;
  }
  std::vector<double> filtered(std::span<const double> timeS,
                               std::span<const double> series) override {
    return smoothed_ ? kelvinVoigtSmoothed(timeS, series, model_).position
                     : kelvinVoigtFiltered(timeS, series, model_);
  }

 private:
  const bool smoothed_;
  KelvinVoigtEstimationOptions known_;
  KelvinVoigtModel model_;
};

}  // namespace

std::unique_ptr<FrameFilter> stretchFilter(const FilterStep& step,
                                           std::shared_ptr<const SensorLayout> layout) {
  if (butterworthOf(step)) return std::make_unique<ZeroPhase>(step, std::move(layout));
  if (step.name == "kelvin-voigt") return std::make_unique<KelvinVoigt>(step, std::move(layout));
  return std::make_unique<Smoother>(step, std::move(layout));
}

}  // namespace palpate::detail

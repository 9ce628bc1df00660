// Filters over the frames of each taxel that need no whole stretch.
#include "filter/temporal_filters.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/time.h"
#include "palpate/filter/butterworth.h"
#include "palpate/filter/kelvin_voigt.h"
#include "palpate/filter/savitzky_golay.h"

#include "filter/spatial_filter.h"
#include "filter/windowed_filter.h"

namespace palpate::detail {
namespace {

// Filters that compute a weighted sum of the frames of a window.
class WeightedFilter : public WindowedFilter {
 protected:
  WeightedFilter(const FilterStep& step, const SensorLayout& layout, Edge edge)
      : WindowedFilter(step.integer("window"), step.flag("centred"), edge),
        places_(placesOf(step, layout)),
        result_(layout.numCells(), 0.0) {}

  // Returns one weight per frame of the window, oldest first.
  virtual const std::vector<double>& weights(std::size_t frames, std::size_t current) = 0;

  void compute(std::span<const float* const> window, std::size_t current, float* values) final {
    const std::vector<double>& weights = this->weights(window.size(), current);
    std::fill(result_.begin(), result_.end(), 0.0);
    for (std::size_t i = 0; i < window.size(); ++i) {
      const double weight = weights[i];
      const float* frame = window[i];
      for (std::size_t place = 0; place < result_.size(); ++place)
        result_[place] += weight * static_cast<double>(frame[place]);
    }
    for (const std::size_t place : places_) values[place] = static_cast<float>(result_[place]);
  }

 private:
  const std::vector<std::size_t> places_;
  std::vector<double> result_;
};

class RunningMean final : public WeightedFilter {
 public:
  RunningMean(const FilterStep& step, const SensorLayout& layout)
      : WeightedFilter(step, layout, Edge::kShrink) {}

 protected:
  const std::vector<double>& weights(std::size_t frames, std::size_t) override {
    if (weights_.size() != frames) weights_.assign(frames, 1.0 / static_cast<double>(frames));
    return weights_;
  }

 private:
  std::vector<double> weights_;
};

class TemporalGaussian final : public WeightedFilter {
 public:
  TemporalGaussian(const FilterStep& step, const SensorLayout& layout)
      : WeightedFilter(step, layout, Edge::kShrink), sigma_(step.value("sigma")) {}

 protected:
  const std::vector<double>& weights(std::size_t frames, std::size_t current) override {
    if (weights_.size() == frames && current == current_) return weights_;
    weights_.clear();
    double sum = 0.0;
    for (std::size_t i = 0; i < frames; ++i) {
      const double t = (static_cast<double>(i) - static_cast<double>(current)) / sigma_;
      weights_.push_back(std::exp(-0.5 * t * t));
      sum += weights_.back();
    }
    for (double& weight : weights_) weight /= sum;
    current_ = current;
    return weights_;
  }

 private:
  const double sigma_;
  std::size_t current_ = 0;
  std::vector<double> weights_;
};

// At the ends of a stretch, uses the polynomial of the first or last window. With fewer frames than
// the order needs, the polynomial passes through all of them.
class SavitzkyGolay final : public WeightedFilter {
 public:
  SavitzkyGolay(const FilterStep& step, const SensorLayout& layout)
      : WeightedFilter(step, layout, Edge::kShift),
        order_(step.integer("order")),
        derivative_(step.integer("derivative")) {}

 protected:
  const std::vector<double>& weights(std::size_t frames, std::size_t current) override {
    if (weights_.size() == frames && current == current_) return weights_;
    current_ = current;
    const int order = std::min(order_, static_cast<int>(frames) - 1);
    if (derivative_ > order) {
      weights_.assign(frames, 0.0);
    } else {
      weights_ = savitzkyGolayWeights(
          static_cast<int>(frames), order, derivative_, static_cast<double>(current));
    }
    return weights_;
  }

 private:
  const int order_;
  const int derivative_;
  std::size_t current_ = 0;
  std::vector<double> weights_;
};

class TemporalMinimum final : public WindowedFilter {
 public:
  TemporalMinimum(const FilterStep& step, const SensorLayout& layout)
      : WindowedFilter(step.integer("window"), step.flag("centred"), Edge::kShrink),
        places_(placesOf(step, layout)),
        result_(layout.numCells(), 0.0F) {}

 protected:
  void compute(std::span<const float* const> window, std::size_t current, float* values) override {
    std::copy(window[current], window[current] + result_.size(), result_.begin());
    for (const float* frame : window)
      for (std::size_t i = 0; i < result_.size(); ++i) result_[i] = std::min(result_[i], frame[i]);
    for (const std::size_t place : places_) values[place] = result_[place];
  }

 private:
  const std::vector<std::size_t> places_;
  std::vector<float> result_;
};

// All taxels have the same noise variances, so that one variance and one gain apply to all.
class KalmanFilter final : public FrameFilter {
 public:
  KalmanFilter(const FilterStep& step, const SensorLayout& layout)
      : places_(placesOf(step, layout)), q_(step.value("q")), r_(step.value("r")) {}

  void push(TactileFrame& frame, FrameSink& out) override {
    if (states_.empty()) {
      states_.reserve(places_.size());
      for (const std::size_t place : places_)
        states_.push_back(static_cast<double>(frame.values[place]));
      variance_ = r_;
      out.take(frame);
      return;
    }
    variance_ += q_;
    const double gain = variance_ / (variance_ + r_);
    variance_ *= 1.0 - gain;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      float& value = frame.values[places_[i]];
      double& state = states_[i];
      state += gain * (static_cast<double>(value) - state);
      // Set small remainders of a past contact to 0, so that they do not stay active for ever.
      if (value == 0.0F && std::abs(state) < kNothing) state = 0.0;
      value = static_cast<float>(state);
    }
    out.take(frame);
  }
  void finish(FrameSink&) override { states_.clear(); }

 private:
  static constexpr double kNothing = 1e-6;  // counts

  const std::vector<std::size_t> places_;
  const double q_;
  const double r_;
  std::vector<double> states_;  // one per place; empty at the beginning of a stretch
  double variance_ = 0.0;
};

// One filter per taxel, all with the same model, so that an interval is discretised once for all.
class KelvinVoigtFrames final : public FrameFilter {
 public:
  KelvinVoigtFrames(const FilterStep& step, const SensorLayout& layout)
      : places_(placesOf(step, layout)),
        model_{.mass = std::isnan(step.value("m")) ? 1.0 : step.value("m"),
               .stiffness = step.value("e"),
               .viscosity = step.value("eta"),
               .forceNoise = step.value("q"),
               .measurementNoise = step.value("r")},
        filters_(places_.size(), KelvinVoigtFilter(model_)) {}

  void push(TactileFrame& frame, FrameSink& out) override {
    if (begun_) step_ = kelvinVoigtStep(model_, static_cast<double>(frame.hostUs - lastUs_) / 1e6);
    begun_ = true;
    lastUs_ = frame.hostUs;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      float& value = frame.values[places_[i]];
      value = static_cast<float>(filters_[i].step(static_cast<double>(value), step_));
    }
    out.take(frame);
  }
  void finish(FrameSink&) override {
    begun_ = false;
    for (KelvinVoigtFilter& filter : filters_) filter.restart();
  }

 private:
  const std::vector<std::size_t> places_;
  const KelvinVoigtModel model_;
  std::vector<KelvinVoigtFilter> filters_;
  KelvinVoigtStep step_;
  std::int64_t lastUs_ = 0;
  bool begun_ = false;
};

// All taxels have the same stamps, so that a section is designed once for all.
class ButterworthFrames final : public FrameFilter {
 public:
  ButterworthFrames(const FilterStep& step, const SensorLayout& layout)
      : places_(placesOf(step, layout)),
        filter_(*butterworthOf(step), places_.size()),
        values_(places_.size(), 0.0) {}

  void push(TactileFrame& frame, FrameSink& out) override {
    const double intervalS = begun_ ? static_cast<double>(frame.hostUs - lastUs_) / kUsPerS : 1.0;
    begun_ = true;
    lastUs_ = frame.hostUs;
    for (std::size_t i = 0; i < places_.size(); ++i)
      values_[i] = static_cast<double>(frame.values[places_[i]]);
    filter_.step(values_, intervalS);
    for (std::size_t i = 0; i < places_.size(); ++i)
      frame.values[places_[i]] = static_cast<float>(values_[i]);
    out.take(frame);
  }
  void finish(FrameSink&) override {
    begun_ = false;
    filter_.restart();
  }

 private:
  const std::vector<std::size_t> places_;
  ButterworthFilter filter_;
  std::vector<double> values_;
  std::int64_t lastUs_ = 0;
  bool begun_ = false;
};

}  // namespace

std::unique_ptr<FrameFilter> temporalFilter(const FilterStep& step,
                                            std::shared_ptr<const SensorLayout> layout) {
  if (step.name == "running-mean") return std::make_unique<RunningMean>(step, *layout);
  if (step.name == "temporal-gaussian") return std::make_unique<TemporalGaussian>(step, *layout);
  if (step.name == "temporal-min") return std::make_unique<TemporalMinimum>(step, *layout);
  if (step.name == "savitzky-golay") return std::make_unique<SavitzkyGolay>(step, *layout);
  if (butterworthOf(step)) return std::make_unique<ButterworthFrames>(step, *layout);
  if (step.name == "kelvin-voigt") return std::make_unique<KelvinVoigtFrames>(step, *layout);
  return std::make_unique<KalmanFilter>(step, *layout);
}

}  // namespace palpate::detail

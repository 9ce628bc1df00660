#include "palpate/filter/kalman.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "filter/sample_stretches.h"

namespace palpate {

void KalmanOptions::validate() const {
  if (!(std::isfinite(q) && q >= 0.0))
    throw std::invalid_argument("kalman: q must be 0 or above, is " + std::to_string(q));
  if (!(std::isfinite(r) && r > 0.0))
    throw std::invalid_argument("kalman: r must be above 0, is " + std::to_string(r));
}

KalmanFilter::KalmanFilter(const KalmanOptions& options) : options_(options) { options.validate(); }

double KalmanFilter::step(double value) noexcept {
  if (!started_) {
    if (!std::isfinite(value)) return value;
    started_ = true;
    state_ = value;
    variance_ = options_.r;
    gain_ = 1.0;
    return state_;
  }
  variance_ += options_.q;
  if (!std::isfinite(value)) return state_;
  gain_ = variance_ / (variance_ + options_.r);
  state_ += gain_ * (value - state_);
  variance_ = gain_ * options_.r;
  return state_;
}

std::vector<double> kalmanFiltered(std::span<const double> values,
                                   const KalmanOptions& options,
                                   std::span<const std::size_t> gapSamples) {
  KalmanFilter filter(options);
  std::vector<double> out(values.size());
  for (const SampleRange& stretch : sampleStretches(values.size(), gapSamples)) {
    filter.restart();
    for (std::size_t i = stretch.begin; i < stretch.end; ++i) out[i] = filter.step(values[i]);
  }
  return out;
}

std::vector<double> rtsSmoothed(std::span<const double> values,
                                const KalmanOptions& options,
                                std::span<const std::size_t> gapSamples) {
  KalmanFilter filter(options);
  std::vector<double> out(values.size());
  std::vector<double> variance(values.size());
  for (const SampleRange& stretch : sampleStretches(values.size(), gapSamples)) {
    filter.restart();
    std::size_t first = stretch.begin;
    for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
      out[i] = filter.step(values[i]);
      variance[i] = filter.variance();
      if (!filter.started()) ++first;
    }
    if (first == stretch.end) continue;
    for (std::size_t i = stretch.end - 1; i-- > first;)
      out[i] += variance[i] / (variance[i] + options.q) * (out[i + 1] - out[i]);
    for (std::size_t i = stretch.begin; i < first; ++i) out[i] = out[first];
  }
  return out;
}

}  // namespace palpate

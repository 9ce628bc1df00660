#include "palpate/live/signal_history.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/calibration/pressure_map.h"
#include "palpate/core/statistics.h"
#include "palpate/core/time.h"
#include "palpate/model/gap_detector.h"

namespace palpate {

KeptTaxels::KeptTaxels(const std::vector<float>& values) {
  const auto isZero = [](float value) { return value == 0.0F; };
  const auto active =
      values.size() - static_cast<std::size_t>(std::count_if(values.begin(), values.end(), isZero));
  if (active > 0 &&
      active * (sizeof(float) + sizeof(std::uint32_t)) >= values.size() * sizeof(float)) {
    values_ = values;
    return;
  }
  places_.reserve(active);
  values_.reserve(active);
  for (std::size_t place = 0; place < values.size(); ++place) {
    if (isZero(values[place])) continue;
    places_.push_back(static_cast<std::uint32_t>(place));
    values_.push_back(values[place]);
  }
}

double KeptTaxels::meanOf(const std::vector<bool>& chosen, std::size_t numChosen) const {
  if (numChosen == 0) return 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const std::size_t place = places_.empty() ? i : places_[i];
    if (place < chosen.size() && chosen[place]) sum += static_cast<double>(values_[i]);
  }
  return sum / static_cast<double>(numChosen);
}

std::size_t KeptTaxels::bytes() const noexcept {
  return places_.size() * sizeof(std::uint32_t) + values_.size() * sizeof(float);
}

std::size_t SignalSample::bytes() const noexcept {
  std::size_t numFurther = 0;
  for (const FurtherSample& each : further) numFurther += each.sample.values.size();
  return sizeof(SignalSample) + further.size() * sizeof(FurtherSample) +
         rows.size() * sizeof(CharacteristicSignals) + taxels.bytes() +
         (anglesDeg.size() + temperatures.size() + forcesN.size() + numFurther) * sizeof(double);
}

SignalHistory::SignalHistory(const SignalHistoryOptions& options) : options_(options) {
  if (!(options_.keepS > 0.0 && std::isfinite(options_.keepS)))
    throw std::invalid_argument("SignalHistoryOptions: keepS must be above 0");
  if (options_.keepSamples == 0)
    throw std::invalid_argument("SignalHistoryOptions: keepSamples must be at least 1");
  if (options_.keepBytes == 0)
    throw std::invalid_argument("SignalHistoryOptions: keepBytes must be at least 1");
}

std::int64_t SignalHistory::medianIntervalUs() const {
  if (intervalsUs_.empty()) return 0;
  return upperMedian(std::vector(intervalsUs_.begin(), intervalsUs_.end()));
}

void SignalHistory::add(const LiveResults& results) {
  auto sample = std::make_shared<SignalSample>();
  sample->hostUs = results.frame->hostUs;
  sample->rows.reserve(results.matrixSignals.size() + 1);
  sample->rows = results.matrixSignals;
  sample->rows.push_back(results.wholeSignals);
  sample->layout = results.frame->layout;
  sample->taxels = KeptTaxels(results.frame->allValues());
  if (results.angles) sample->anglesDeg = results.angles->values;
  if (results.temperatures) sample->temperatures = results.temperatures->values;
  sample->further = results.further;
  if (results.pressure) {
    sample->forcesN.reserve(results.pressure->matrices.size() + 1);
    for (const MatrixPressure& matrix : results.pressure->matrices)
      sample->forcesN.push_back(matrix.forceN);
    sample->forcesN.push_back(results.pressure->forceN);
  }

  const std::lock_guard lock(mutex_);
  if (!samples_.empty()) {
    const std::int64_t intervalUs = sample->hostUs - samples_.back()->hostUs;
    if (intervalUs <= 0) return;
    sample->afterGap = intervalUs > gapThresholdUs(medianIntervalUs());
    intervalsUs_.push_back(intervalUs);
    if (intervalsUs_.size() > kIntervals) intervalsUs_.pop_front();
  }
  bytes_ += sample->bytes();
  samples_.push_back(std::move(sample));
  const auto oldestUs =
      samples_.back()->hostUs - static_cast<std::int64_t>(options_.keepS * kUsPerS);
  // The newest sample is always kept.
  while (samples_.size() > 1 &&
         (samples_.size() > options_.keepSamples || bytes_ > options_.keepBytes ||
          samples_.front()->hostUs < oldestUs)) {
    bytes_ -= samples_.front()->bytes();
    samples_.pop_front();
  }
}

void SignalHistory::clear() {
  const std::lock_guard lock(mutex_);
  samples_.clear();
  bytes_ = 0;
  intervalsUs_.clear();
}

std::vector<SharedSignalSample> SignalHistory::after(std::int64_t hostUs) const {
  const std::lock_guard lock(mutex_);
  const auto from = std::upper_bound(
      samples_.begin(),
      samples_.end(),
      hostUs,
      [](std::int64_t us, const SharedSignalSample& sample) { return us < sample->hostUs; });
  return {from, samples_.end()};
}

std::optional<std::int64_t> SignalHistory::oldestUs() const {
  const std::lock_guard lock(mutex_);
  return samples_.empty() ? std::nullopt : std::optional(samples_.front()->hostUs);
}

std::size_t SignalHistory::size() const {
  const std::lock_guard lock(mutex_);
  return samples_.size();
}

std::size_t SignalHistory::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

}  // namespace palpate

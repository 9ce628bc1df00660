#include "palpate/live/signal_history.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/core/statistics.h"
#include "palpate/core/time.h"
#include "palpate/model/gap_detector.h"

namespace palpate {

SignalHistory::SignalHistory(const SignalHistoryOptions& options) : options_(options) {
  if (!(options_.keepS > 0.0 && std::isfinite(options_.keepS)))
    throw std::invalid_argument("SignalHistoryOptions: keepS must be above 0");
  if (options_.keepSamples == 0)
    throw std::invalid_argument("SignalHistoryOptions: keepSamples must be at least 1");
}

std::int64_t SignalHistory::medianIntervalUs() const {
  if (intervalsUs_.empty()) return 0;
  return upperMedian(std::vector(intervalsUs_.begin(), intervalsUs_.end()));
}

void SignalHistory::add(const LiveResults& results) {
  SignalSample sample;
  sample.hostUs = results.frame->hostUs;
  sample.rows.reserve(results.matrixSignals.size() + 1);
  sample.rows = results.matrixSignals;
  sample.rows.push_back(results.wholeSignals);

  const std::lock_guard lock(mutex_);
  if (!samples_.empty()) {
    const std::int64_t intervalUs = sample.hostUs - samples_.back().hostUs;
    if (intervalUs <= 0) return;
    sample.afterGap = intervalUs > gapThresholdUs(medianIntervalUs());
    intervalsUs_.push_back(intervalUs);
    if (intervalsUs_.size() > kIntervals) intervalsUs_.pop_front();
  }
  samples_.push_back(std::move(sample));
  const auto oldestUs =
      samples_.back().hostUs - static_cast<std::int64_t>(options_.keepS * kUsPerS);
  while (samples_.size() > options_.keepSamples || samples_.front().hostUs < oldestUs)
    samples_.pop_front();
}

void SignalHistory::clear() {
  const std::lock_guard lock(mutex_);
  samples_.clear();
  intervalsUs_.clear();
}

std::vector<SignalSample> SignalHistory::after(std::int64_t hostUs) const {
  const std::lock_guard lock(mutex_);
  const auto from = std::upper_bound(
      samples_.begin(), samples_.end(), hostUs, [](std::int64_t us, const SignalSample& sample) {
        return us < sample.hostUs;
      });
  return {from, samples_.end()};
}

std::size_t SignalHistory::size() const {
  const std::lock_guard lock(mutex_);
  return samples_.size();
}

}  // namespace palpate

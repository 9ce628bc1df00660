// The last minutes of the characteristic signals, for a rolling chart: filled by live processing,
// read by the display.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

#include <palpate/live/live_results.h>
#include <palpate/signals/characteristic_signals.h>

namespace palpate {

struct SignalSample {
  std::int64_t hostUs = 0;  // stamp of the frame [us since 1970]
  // True when the sample follows a gap of more than max(1 s, 5 median intervals); the chart then
  // draws no line to it.
  bool afterGap = false;
  std::vector<CharacteristicSignals> rows;  // one per matrix, then all matrices together
};

struct SignalHistoryOptions {
  double keepS = 300.0;  // [s], > 0
  // Maximum number of samples at any rate; about 0.4 kB each.
  std::size_t keepSamples = 30000;
};

// Every function may be called from any thread.
class SignalHistory {
 public:
  // Throws std::invalid_argument naming the field.
  explicit SignalHistory(const SignalHistoryOptions& options = {});

  // Adds the results of SignalsStage. A frame that isn't later than the last one is ignored.
  void add(const LiveResults& results);
  void clear();
  // Samples later than a stamp, oldest first.
  std::vector<SignalSample> after(std::int64_t hostUs) const;
  std::size_t size() const;

 private:
  std::int64_t medianIntervalUs() const;

  static constexpr std::size_t kIntervals = 15;
  const SignalHistoryOptions options_;
  mutable std::mutex mutex_;
  std::deque<SignalSample> samples_;
  std::deque<std::int64_t> intervalsUs_;  // newest intervals [us]
};

}  // namespace palpate

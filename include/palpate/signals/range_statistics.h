// What a signal does over a range of time, in a few numbers, and its change between the ends: for
// the selection in the timeline.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>

namespace palpate {

// Of the finite samples of a range. A number is NaN where there are too few samples for it.
struct RangeStatistics {
  std::size_t count = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();
  // Standard deviation with n - 1; needs two samples.
  double sd = std::numeric_limits<double>::quiet_NaN();
  double minimum = std::numeric_limits<double>::quiet_NaN();
  double maximum = std::numeric_limits<double>::quiet_NaN();
  // Slope of the line of least squares [unit/s]; needs two samples at different times.
  double slope = std::numeric_limits<double>::quiet_NaN();
  // Integral over time by the trapezoidal rule [unit s]. Intervals longer than `longestS` (gaps)
  // are left out; 0 with one sample.
  double integral = std::numeric_limits<double>::quiet_NaN();
  // Of an even number of samples the mean of the two in the middle.
  double median = std::numeric_limits<double>::quiet_NaN();
  double rms = std::numeric_limits<double>::quiet_NaN();  // root of the mean square
};

// `timeS`: times of the samples [s], ascending. Throws std::invalid_argument when the numbers of
// times and values differ.
RangeStatistics rangeStatistics(std::span<const double> timeS,
                                std::span<const double> values,
                                double longestS = std::numeric_limits<double>::infinity());

// The change of a signal over a range: between its first and its last finite sample there.
struct RangeChange {
  double fromS = 0.0;  // time of the first one [s]
  double toS = 0.0;    // time of the last one [s]
  double from = 0.0;
  double to = 0.0;
  double difference() const noexcept { return to - from; }
  // [unit/s]; nothing: both are the same sample.
  std::optional<double> rate() const noexcept {
    return toS > fromS ? std::optional(difference() / (toS - fromS)) : std::nullopt;
  }
};

// `numSamples`: samples in the range; `timeSAt`, `valueAt`: the time [s] and the value of each, in
// the order of time; a value is NaN where there is none. Values are asked for from both ends, up to
// a finite one. Nothing: no value is finite.
std::optional<RangeChange> rangeChange(std::size_t numSamples,
                                       const std::function<double(std::size_t)>& timeSAt,
                                       const std::function<double(std::size_t)>& valueAt);

}  // namespace palpate

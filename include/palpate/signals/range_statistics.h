// What a signal does over a range of time, in seven numbers: for the selection in the timeline.
#pragma once

#include <cstddef>
#include <limits>
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
};

// `timeS`: times of the samples [s], ascending. Throws std::invalid_argument when the numbers of
// times and values differ.
RangeStatistics rangeStatistics(std::span<const double> timeS,
                                std::span<const double> values,
                                double longestS = std::numeric_limits<double>::infinity());

}  // namespace palpate

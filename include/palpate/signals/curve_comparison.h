// Compares two curves over the span of time that both cover, or a part of it, for the comparison of
// two recordings or grasps.
//
// Both are resampled on one time base: from the start of the common span in steps of the longer of
// the two median intervals, so that no values are invented between the samples of the slower
// recording. Each curve is interpolated linearly between its neighbouring samples. Times in a gap
// of either curve are left out. The correlation is Pearson's over that time base; like the other
// figures it is symmetric in A and B, except for the sign of A - B.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <palpate/signals/alignment.h>
#include <palpate/signals/profile_series.h>

namespace palpate {

// Result of the comparison of two curves A and B.
struct CurveComparison {
  std::size_t samples = 0;  // on the common time base
  double fromS = 0.0;       // the span that is compared, on A's time axis [s]
  double toS = 0.0;
  // Step of the time base [s]; 0 when both curves have fewer than two samples.
  double stepS = 0.0;
  // Mean of A - B, in the unit of the curves.
  double meanDifference = 0.0;
  double rmsDifference = 0.0;
  // The difference with the largest magnitude, with its sign; and its time [s].
  double largestDifference = 0.0;
  double largestAtS = 0.0;
  // -1..1; empty with fewer than three samples, or when a curve is constant.
  std::optional<double> correlation = {};
};

// Compares two curves. Times ascend [s]; `offsetS` is added to those of B to get A's axis.
// Intervals longer than those in CurveGaps [s] are gaps; with 0 there are none. NaN counts as a
// gap. `within`: only this part of A's axis, of two grasps graspsInCommon(). Throws
// std::invalid_argument when the numbers of times and values differ.
struct CurveGaps {
  double aS = 0.0;
  double bS = 0.0;
};
CurveComparison compareCurves(const Series& a,
                              const Series& b,
                              double offsetS,
                              const CurveGaps& gaps = {},
                              const std::optional<TimeSpan>& within = {});
// Longest interval that is no gap (model/timing.h): max(1 s, 5 median intervals).
double gapFromS(const TimingReport& timing);
// The same of the times of a series, ascending [s].
double gapOfTimesS(std::span<const double> timeS);
// The last sample at or before a time [s]; empty: there is none within `longestS`.
std::optional<std::size_t> sampleAt(const Series& series, double timeS, double longestS);

}  // namespace palpate

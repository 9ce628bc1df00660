// Several curves laid over each other at a moment that they have in common (a contact), and their
// average with a band: for repeated grasps. The comparison of recordings and `palpate compare
// --average` use it.
//
// Time 0 is the common moment. The curves are resampled on one time base k * step, k = .., -1, 0,
// 1, .., by linear interpolation; times in a gap of a curve, and outside of its span, are left out
// for that curve only, as are values that aren't finite. At each time the average is over the
// curves that have a value there:
//   kStandardDeviation  mean, mean - s, mean + s; s with n - 1 (as numpy.std(ddof=1))
//   kPercentiles        median, and two percentiles by linear interpolation (as numpy.percentile)
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <palpate/core/option_check.h>
#include <palpate/core/progress.h>
#include <palpate/model/timing.h>
#include <palpate/signals/profile_series.h>

namespace palpate {

// A stretch of a curve, and its moment that the curves have in common.
struct AlignedCurve {
  // Never null; times ascend strictly [s].
  std::shared_ptr<const Series> series = {};
  // The time of `series` that becomes 0 [s].
  double zeroS = 0.0;
  // The stretch, on the time axis of `series` [s].
  double fromS = -std::numeric_limits<double>::infinity();
  double toS = std::numeric_limits<double>::infinity();
  // Longer intervals between samples are gaps [s].
  double longestS = std::numeric_limits<double>::infinity();
};

enum class AverageBand { kStandardDeviation, kPercentiles };
inline constexpr std::array<OptionWord<AverageBand>, 2> kAverageBandWords{
    {{"sd", AverageBand::kStandardDeviation}, {"percentiles", AverageBand::kPercentiles}}};

struct AverageOptions {
  AverageBand band = AverageBand::kStandardDeviation;
  // For kPercentiles: 0 <= low < high <= 100.
  double lowPercent = 10.0;
  double highPercent = 90.0;
  // Step of the time base [s]; 0: the longest of the curves' median intervals. It becomes
  // longer when the time base would have more than 200,000 times.
  static constexpr OptionRange kStepS{1e-6, 1e6, "s"};
  double stepS = 0.0;
  // Times at which fewer curves have a value are NaN.
  static constexpr OptionRange kMinimum{1, INT32_MAX};
  std::size_t least = 2;

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// NaN where fewer than `least` curves have a value; low and high also where only one has.
struct AverageCurve {
  double stepS = 0.0;
  std::vector<double> timeS = {};   // from the common moment
  std::vector<double> middle = {};  // mean or median, in the unit of the curves
  std::vector<double> low = {};
  std::vector<double> high = {};
  // Number of curves with a value at each time.
  std::vector<std::size_t> count = {};
};

// The stretches of a curve around spans of time (grasps), each with its begin as the common moment
// and `marginS` [s] before and after it, but not into the neighbouring spans. The spans ascend.
std::vector<AlignedCurve> alignedStretches(std::shared_ptr<const Series> series,
                                           std::span<const TimeSpan> spans,
                                           double marginS,
                                           double longestS);

// Empty when no curve has a sample in its stretch. Throws std::invalid_argument for bad options, a
// null series, or times that don't ascend; Cancelled.
AverageCurve averageCurve(std::span<const AlignedCurve> curves,
                          const AverageOptions& options = {},
                          const Progress& progress = {});

// The curve on a time base of an average: `timeS` from its zero. NaN where it has no value.
std::vector<double> alignedValues(const AlignedCurve& curve, std::span<const double> timeS);

}  // namespace palpate

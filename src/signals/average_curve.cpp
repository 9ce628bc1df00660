#include "palpate/signals/average_curve.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/signals/resampled_series.h"

namespace palpate {
namespace {

constexpr double kMaxTimes = 2e5;
constexpr double kAverageNan = std::numeric_limits<double>::quiet_NaN();

// The samples of the stretch.
struct Part {
  std::size_t begin = 0;
  std::size_t end = 0;
};

Part partOf(const AlignedCurve& curve) {
  if (!curve.series) throw std::invalid_argument("AlignedCurve: series is null");
  const auto& timeS = curve.series->timeS;
  const auto at = [&](auto found) { return static_cast<std::size_t>(found - timeS.begin()); };
  return {at(std::lower_bound(timeS.begin(), timeS.end(), curve.fromS)),
          at(std::upper_bound(timeS.begin(), timeS.end(), curve.toS))};
}

// Median interval between the samples of the stretch [s]; 0: there are fewer than two.
double medianIntervalS(const AlignedCurve& curve) {
  const auto [begin, end] = partOf(curve);
  std::vector<double> intervals;
  for (std::size_t i = begin + 1; i < end; ++i)
    intervals.push_back(curve.series->timeS[i] - curve.series->timeS[i - 1]);
  if (intervals.empty()) return 0.0;
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

// Of ascending values, by linear interpolation between the closest ranks.
double percentileOf(const std::vector<double>& sorted, double percent) {
  const double rank = percent / 100.0 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

struct MiddleAndBand {
  double middle = kAverageNan, low = kAverageNan, high = kAverageNan;
};

MiddleAndBand middleAndBand(std::vector<double>& values, const AverageOptions& options) {
  const auto n = static_cast<double>(values.size());
  if (values.size() < options.least) return {};
  if (options.band == AverageBand::kPercentiles) {
    constexpr double kMedian = 50.0;
    std::sort(values.begin(), values.end());
    MiddleAndBand found{.middle = percentileOf(values, kMedian)};
    if (values.size() < 2) return found;
    found.low = percentileOf(values, options.lowPercent);
    found.high = percentileOf(values, options.highPercent);
    return found;
  }
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  MiddleAndBand found{.middle = sum / n};
  if (values.size() < 2) return found;
  for (const double value : values) squares += (value - found.middle) * (value - found.middle);
  const double deviation = std::sqrt(squares / (n - 1.0));
  found.low = found.middle - deviation;
  found.high = found.middle + deviation;
  return found;
}

}  // namespace

void AverageOptions::validate() const {
  constexpr OptionCheck check{"AverageOptions"};
  check(lowPercent >= 0.0, "lowPercent", lowPercent);
  check(highPercent > lowPercent && highPercent <= 100.0, "highPercent", highPercent);
  if (stepS != 0.0) check(kStepS, "stepS", stepS);
  check(kMinimum, "least", static_cast<double>(least));
}

std::vector<AlignedCurve> alignedStretches(std::shared_ptr<const Series> series,
                                           std::span<const TimeSpan> spans,
                                           double marginS,
                                           double longestS) {
  std::vector<AlignedCurve> stretches;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    AlignedCurve stretch{.series = series,
                         .zeroS = spans[i].fromS,
                         .fromS = spans[i].fromS - marginS,
                         .toS = spans[i].toS + marginS,
                         .longestS = longestS};
    if (i > 0) stretch.fromS = std::min(spans[i].fromS, std::max(stretch.fromS, spans[i - 1].toS));
    if (i + 1 < spans.size())
      stretch.toS = std::max(spans[i].toS, std::min(stretch.toS, spans[i + 1].fromS));
    stretches.push_back(std::move(stretch));
  }
  return stretches;
}

std::vector<double> alignedValues(const AlignedCurve& curve, std::span<const double> timeS) {
  const auto [begin, end] = partOf(curve);
  Series part;
  for (std::size_t i = begin; i < end; ++i) {
    part.timeS.push_back(curve.series->timeS[i] - curve.zeroS);
    part.values.push_back(curve.series->values[i]);
  }
  if (part.timeS.empty()) return std::vector<double>(timeS.size(), kAverageNan);
  // A time that differs from the first or the last sample only by rounding has its value.
  constexpr double kRoundingS = 5e-7;
  std::vector<double> wanted(timeS.begin(), timeS.end());
  for (double& each : wanted)
    for (const double edge : {part.timeS.front(), part.timeS.back()})
      if (std::abs(each - edge) < kRoundingS) each = edge;
  return resampled(part, wanted, curve.longestS);
}

AverageCurve averageCurve(std::span<const AlignedCurve> curves,
                          const AverageOptions& options,
                          const Progress& progress) {
  options.validate();
  AverageCurve average{.stepS = options.stepS};
  std::optional<double> fromS, toS;
  double longestMedianS = 0.0;
  for (const AlignedCurve& curve : curves) {
    const auto [begin, end] = partOf(curve);
    if (begin >= end) continue;
    const double first = curve.series->timeS[begin] - curve.zeroS;
    const double last = curve.series->timeS[end - 1] - curve.zeroS;
    fromS = std::min(first, fromS.value_or(first));
    toS = std::max(last, toS.value_or(last));
    longestMedianS = std::max(longestMedianS, medianIntervalS(curve));
  }
  if (!fromS) return average;
  if (average.stepS == 0.0) average.stepS = longestMedianS > 0.0 ? longestMedianS : 1.0;
  average.stepS = std::max(average.stepS, (*toS - *fromS) / kMaxTimes);
  // A multiple of the step that differs from an end only by rounding still counts.
  constexpr double kRounding = 1e-6;
  const double firstStep = std::ceil(*fromS / average.stepS - kRounding);
  const double lastStep = std::floor(*toS / average.stepS + kRounding);
  for (double k = firstStep; k <= lastStep; ++k) average.timeS.push_back(k * average.stepS);
  const std::size_t numTimes = average.timeS.size();
  std::vector<std::vector<double>> resampledCurves;
  for (const AlignedCurve& curve : curves) {
    if (progress &&
        !progress(static_cast<double>(resampledCurves.size()) / static_cast<double>(curves.size())))
      throw Cancelled();
    resampledCurves.push_back(alignedValues(curve, average.timeS));
  }
  average.count.reserve(numTimes);
  std::vector<double> here;
  for (std::size_t i = 0; i < numTimes; ++i) {
    here.clear();
    for (const auto& values : resampledCurves)
      if (std::isfinite(values[i])) here.push_back(values[i]);
    average.count.push_back(here.size());
    const MiddleAndBand found = middleAndBand(here, options);
    average.middle.push_back(found.middle);
    average.low.push_back(found.low);
    average.high.push_back(found.high);
  }
  return average;
}

}  // namespace palpate

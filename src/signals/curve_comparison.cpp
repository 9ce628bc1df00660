#include "palpate/signals/curve_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "palpate/core/statistics.h"
#include "palpate/model/gap_detector.h"

namespace palpate {
namespace {

constexpr double kRoundingS = 1e-7;  // stamps are whole microseconds
constexpr std::size_t kMaxSamples = 20'000'000;

void checkCurveComparison(const Series& series) {
  if (series.timeS.size() != series.values.size())
    throw std::invalid_argument("compareCurves: " + std::to_string(series.timeS.size()) +
                                " times, " + std::to_string(series.values.size()) + " values");
}

double medianInterval(const Series& series) {
  if (series.timeS.size() < 2) return 0.0;
  std::vector<double> intervals(series.timeS.size() - 1);
  for (std::size_t i = 0; i < intervals.size(); ++i)
    intervals[i] = series.timeS[i + 1] - series.timeS[i];
  return upperMedian(std::move(intervals));
}

// Reads a curve at ascending times.
class CurveComparisonCursor {
 public:
  CurveComparisonCursor(const Series& series, double shiftS, double gapS)
      : series_(series), shiftS_(shiftS), gapS_(gapS) {}

  // Returns NaN inside a gap and outside of the curve.
  double at(double momentS) {
    const double seconds = momentS - shiftS_;
    const auto& times = series_.timeS;
    while (next_ < times.size() && times[next_] <= seconds + kRoundingS) ++next_;
    if (next_ == 0) return std::numeric_limits<double>::quiet_NaN();
    const std::size_t i = next_ - 1;
    if (seconds - times[i] <= kRoundingS) return series_.values[i];
    if (next_ == times.size()) return std::numeric_limits<double>::quiet_NaN();
    const double interval = times[next_] - times[i];
    if (gapS_ > 0.0 && interval > gapS_) return std::numeric_limits<double>::quiet_NaN();
    const double share = (seconds - times[i]) / interval;
    return series_.values[i] + share * (series_.values[next_] - series_.values[i]);
  }

 private:
  const Series& series_;
  double shiftS_;
  double gapS_;
  std::size_t next_ = 0;  // first sample after the requested time
};

// Means and squared deviations, updated sample by sample (Welford), so that long curves lose no
// digits.
struct Moments {
  double n = 0.0;
  double meanA = 0.0, meanB = 0.0;
  double squaresA = 0.0, squaresB = 0.0, products = 0.0;

  void add(double a, double b) {
    n += 1.0;
    const double fromA = a - meanA;
    const double fromB = b - meanB;
    meanA += fromA / n;
    meanB += fromB / n;
    squaresA += fromA * (a - meanA);
    squaresB += fromB * (b - meanB);
    products += fromA * (b - meanB);
  }
  std::optional<double> correlation() const {
    constexpr double kMinIntervals = 3.0;
    // Rounding errors of a constant curve do not count as variation.
    constexpr double kRelative = 1e-12;
    const auto constant = [&](double squares, double mean) {
      return !(squares > kRelative * n * std::max(1e-12, mean * mean));
    };
    if (n < kMinIntervals || constant(squaresA, meanA) || constant(squaresB, meanB))
      return std::nullopt;
    return std::clamp(products / std::sqrt(squaresA) / std::sqrt(squaresB), -1.0, 1.0);
  }
};

}  // namespace

double gapFromS(const TimingReport& timing) {
  return gapThresholdS(timing.rateHz > 0.0 ? 1.0 / timing.rateHz : 0.0);
}

double gapOfTimesS(std::span<const double> timeS) {
  if (timeS.size() < 2) return gapThresholdS(0.0);
  std::vector<double> intervals(timeS.size() - 1);
  for (std::size_t i = 0; i < intervals.size(); ++i) intervals[i] = timeS[i + 1] - timeS[i];
  return gapThresholdS(upperMedian(std::move(intervals)));
}

std::optional<std::size_t> sampleAt(const Series& series, double timeS, double longestS) {
  const auto after = std::ranges::upper_bound(series.timeS, timeS);
  if (after == series.timeS.begin() || timeS - *(after - 1) > longestS) return std::nullopt;
  return static_cast<std::size_t>(after - series.timeS.begin()) - 1;
}

CurveComparison compareCurves(const Series& a,
                              const Series& b,
                              double offsetS,
                              const CurveGaps& gaps,
                              const std::optional<TimeSpan>& within) {
  checkCurveComparison(a);
  checkCurveComparison(b);
  CurveComparison report;
  if (a.timeS.empty() || b.timeS.empty()) return report;
  report.fromS = std::max(a.timeS.front(), b.timeS.front() + offsetS);
  report.toS = std::min(a.timeS.back(), b.timeS.back() + offsetS);
  if (within) {
    report.fromS = std::max(report.fromS, within->fromS);
    report.toS = std::min(report.toS, within->toS);
  }
  if (report.toS < report.fromS - kRoundingS) return report;
  const double span = std::max(0.0, report.toS - report.fromS);
  report.stepS = std::max(medianInterval(a), medianInterval(b));
  std::size_t moments = 1;
  if (report.stepS > 0.0)
    moments += static_cast<std::size_t>(
        std::min((span + kRoundingS) / report.stepS, static_cast<double>(kMaxSamples)));
  CurveComparisonCursor readA(a, 0.0, gaps.aS), readB(b, offsetS, gaps.bS);
  Moments sums;
  double squares = 0.0;
  for (std::size_t i = 0; i < moments; ++i) {
    const double momentS = report.fromS + static_cast<double>(i) * report.stepS;
    const double inA = readA.at(momentS);
    const double inB = readB.at(momentS);
    if (!std::isfinite(inA) || !std::isfinite(inB)) continue;
    const double difference = inA - inB;
    sums.add(inA, inB);
    squares += difference * difference;
    if (report.samples++ > 0 && std::abs(difference) <= std::abs(report.largestDifference))
      continue;
    report.largestDifference = difference;
    report.largestAtS = momentS;
  }
  if (report.samples == 0) return report;
  report.meanDifference = sums.meanA - sums.meanB;
  report.rmsDifference = std::sqrt(squares / static_cast<double>(report.samples));
  report.correlation = sums.correlation();
  return report;
}

}  // namespace palpate

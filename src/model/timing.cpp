#include "palpate/model/timing.h"

#include <algorithm>

#include "palpate/model/gap_detector.h"

namespace palpate {
namespace {

// Mean of the two middle values where their number is even. Reorders `values`.
double median(std::vector<std::int64_t>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return static_cast<double>(*middle);
  const auto below = *std::max_element(values.begin(), middle);
  return 0.5 * (static_cast<double>(below) + static_cast<double>(*middle));
}

}  // namespace

TimingReport timingOf(const Profile& profile) {
  std::vector<std::int64_t> stampsUs(profile.numFrames());
  for (std::size_t i = 0; i < stampsUs.size(); ++i) stampsUs[i] = profile.frameTimeUs(i);
  return timingOf(stampsUs);
}

TimingReport timingOf(std::span<const std::int64_t> stampsUs) {
  TimingReport report;
  if (stampsUs.size() < 2) return report;
  std::vector<std::int64_t> intervals(stampsUs.size() - 1);
  for (std::size_t i = 0; i < intervals.size(); ++i) intervals[i] = stampsUs[i + 1] - stampsUs[i];
  std::vector<std::int64_t> sorted = intervals;
  const double medianUs = median(sorted);
  report.durationS = static_cast<double>(stampsUs.back() - stampsUs.front()) / 1e6;
  report.rateHz = 1e6 / medianUs;
  report.meanRateHz = static_cast<double>(intervals.size()) / report.durationS;
  const double gapUs = std::max<double>(kShortestGapUs, kGapIntervals * medianUs);
  for (std::size_t i = 0; i < intervals.size(); ++i)
    if (static_cast<double>(intervals[i]) > gapUs)
      report.gaps.push_back({i, static_cast<double>(intervals[i]) / 1e6});
  return report;
}

}  // namespace palpate

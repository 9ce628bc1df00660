#include "palpate/model/timing.h"

#include "palpate/core/statistics.h"
#include "palpate/model/gap_detector.h"

namespace palpate {

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
  const double medianUs = median(std::vector(intervals));
  report.durationS = static_cast<double>(stampsUs.back() - stampsUs.front()) / 1e6;
  report.meanRateHz = static_cast<double>(intervals.size()) / report.durationS;
  const double gapUs = gapThresholdUs(medianUs);
  double betweenUs = report.durationS * 1e6;
  for (std::size_t i = 0; i < intervals.size(); ++i)
    if (static_cast<double>(intervals[i]) > gapUs) {
      report.gaps.push_back({i, static_cast<double>(intervals[i]) / 1e6});
      betweenUs -= static_cast<double>(intervals[i]);
    }
  const UsualRate rate = usualRateOf(medianUs, betweenUs, intervals.size() - report.gaps.size());
  report.rateHz = rate.hz;
  report.inBursts = rate.inBursts;
  return report;
}

}  // namespace palpate

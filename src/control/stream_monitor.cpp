#include "palpate/control/stream_monitor.h"

#include <algorithm>
#include <span>

#include "palpate/core/statistics.h"

namespace palpate {

std::optional<std::int64_t> StreamMonitor::frame(std::int64_t stampUs, std::int64_t monoUs) {
  std::optional<std::int64_t> silence;
  if (lastStampUs_) {
    const std::int64_t periodUs = stampUs - *lastStampUs_;
    if (known() && periodUs > silenceLimitUs()) silence = periodUs;
    periods_[count_ % kKept] = periodUs;
    ++count_;
  }
  lastStampUs_ = stampUs;
  lastMonoUs_ = monoUs;
  return silence;
}

std::int64_t StreamMonitor::medianPeriodUs() const {
  if (!known()) return 0;
  auto sorted = periods_;
  return upperMedian(std::span(sorted).first(std::min(count_, kKept)));
}

std::int64_t StreamMonitor::silenceLimitUs() const {
  return std::max(kMinSilenceUs, kPeriods * medianPeriodUs());
}

std::optional<std::int64_t> StreamMonitor::silenceUs(std::int64_t monoUs) const {
  if (!lastStampUs_) return std::nullopt;
  return monoUs - lastMonoUs_;
}

bool StreamMonitor::alive(std::int64_t monoUs) const {
  const auto silence = silenceUs(monoUs);
  return known() && silence && *silence <= silenceLimitUs();
}

}  // namespace palpate

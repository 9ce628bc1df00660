#include "palpate/control/stream_monitor.h"

#include <algorithm>

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
  const auto size = static_cast<std::ptrdiff_t>(std::min(count_, kKept));
  std::nth_element(sorted.begin(), sorted.begin() + size / 2, sorted.begin() + size);
  return sorted[static_cast<std::size_t>(size / 2)];
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

#include "palpate/model/gap_detector.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "palpate/core/statistics.h"

namespace palpate {
namespace {

constexpr std::size_t kIntervals = 15;

}  // namespace

std::int64_t GapDetector::medianIntervalUs() const {
  std::array<std::int64_t, kIntervals> sorted{};
  const auto end = std::copy(intervalsUs_.begin(), intervalsUs_.end(), sorted.begin());
  return upperMedian(std::span(sorted.begin(), end));
}

bool GapDetector::afterGap(std::int64_t stampUs) {
  const std::int64_t intervalUs = stampUs - lastUs_;
  const bool second = any_;
  lastUs_ = stampUs;
  any_ = true;
  if (!second) return false;
  if (std::exchange(loss_, false)) return true;  // its interval is not that of two frames
  // The median is computed only when the interval is long enough to be a gap.
  const bool gap = intervalUs > kShortestGapUs && !intervalsUs_.empty() &&
                   intervalUs > gapThresholdUs(medianIntervalUs());
  intervalsUs_.push_back(intervalUs);
  if (intervalsUs_.size() > kIntervals) intervalsUs_.pop_front();
  return gap;
}

void GapDetector::reset() {
  any_ = loss_ = false;
  intervalsUs_.clear();
}

}  // namespace palpate

// Tells gaps between frames as they come, from the stamps of the past alone: live and in a
// recording the same frames give the same answers. (timing.h looks at a whole recording at once.)
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>

namespace palpate {

// Two neighbours in time are a gap apart when they are further than max(kShortestGapS,
// kGapIntervals medians of their intervals).
inline constexpr std::int64_t kShortestGapUs = 1'000'000;  // [us]
inline constexpr double kShortestGapS = 1.0;               // [s]
inline constexpr int kGapIntervals = 5;

// The longest interval that is no gap, of the median interval.
constexpr double gapThresholdS(double medianS) {
  return std::max(kShortestGapS, kGapIntervals * medianS);
}
template <typename Us>
constexpr Us gapThresholdUs(Us medianUs) {
  return std::max<Us>(kShortestGapUs, kGapIntervals * medianUs);
}

class GapDetector {
 public:
  // The next stamp [us], ascending. True: the interval before it is longer than max(1 s, 5 medians
  // of the last 15 intervals). Never before the first and the second frame: no rate is known yet.
  bool afterGap(std::int64_t stampUs);
  void reset();

 private:
  std::int64_t medianIntervalUs() const;

  std::int64_t lastUs_ = 0;
  bool any_ = false;
  std::deque<std::int64_t> intervalsUs_;  // the last ones
};

}  // namespace palpate

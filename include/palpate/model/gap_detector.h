// Finds gaps between frames while the frames arrive, from past time stamps alone, so that a live
// source and a recording give the same answers for the same frames. Filters, playback and the live
// stages use it. (timing.h looks at a whole recording at once.)
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>

namespace palpate {

// Two neighbouring frames have a gap between them when their interval is longer than
// max(kShortestGapS, kGapIntervals * median interval).
inline constexpr std::int64_t kShortestGapUs = 1'000'000;  // [us]
inline constexpr double kShortestGapS = 1.0;               // [s]
inline constexpr int kGapIntervals = 5;
inline constexpr double kBurstIntervals = 4.0;

// The longest interval that is no gap, for a given median interval.
constexpr double gapThresholdS(double medianS) {
  return std::max(kShortestGapS, kGapIntervals * medianS);
}
template <typename Us>
constexpr Us gapThresholdUs(Us medianUs) {
  return std::max<Us>(kShortestGapUs, kGapIntervals * medianUs);
}

// Frames come in bursts when so many of them arrive together that the median interval says nothing
// of their rate; `mean`: of the intervals that are no gaps.
constexpr bool isInBursts(double medianUs, double meanUs) {
  return kBurstIntervals * medianUs < meanUs;
}

// The rate of frames [Hz]: 1 / median interval, or 1 / mean interval when they come in bursts.
// `withoutGapsUs` is the sum of the `intervals` that are no gaps.
struct UsualRate {
  double hz = 0.0;
  bool inBursts = false;
};
constexpr UsualRate usualRateOf(double medianUs, double withoutGapsUs, std::size_t intervals) {
  const double meanUs = withoutGapsUs / static_cast<double>(std::max<std::size_t>(intervals, 1));
  const bool inBursts = isInBursts(medianUs, meanUs);
  return {1e6 / (inBursts ? meanUs : medianUs), inBursts};
}

// Finds gaps in a series of time stamps that are passed one by one.
class GapDetector {
 public:
  // Takes the next stamp [us]; stamps must ascend. Returns true when the interval before it is
  // longer than max(1 s, 5 medians of the last 15 intervals). The first and the second frame never
  // follow a gap, since the frame rate is not known yet.
  bool afterGap(std::int64_t stampUs);
  // Frames before the next stamp are lost: it follows a gap, however short the interval is.
  void setLoss() noexcept { loss_ = any_; }
  // Forgets all stamps, for a new source.
  void reset();

 private:
  std::int64_t medianIntervalUs() const;

  std::int64_t lastUs_ = 0;
  bool any_ = false;
  bool loss_ = false;
  std::deque<std::int64_t> intervalsUs_;  // the last 15 intervals
};

}  // namespace palpate

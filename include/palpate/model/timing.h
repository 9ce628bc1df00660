// Rates and gaps of the frames of a profile, computed from the time stamps alone, and a span of
// time in a recording.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <palpate/model/profile.h>

namespace palpate {

// A gap: two neighbouring frames are too far apart because recording was suspended or data was
// lost.
struct Gap {
  std::size_t frame = 0;  // last frame before the gap
  double seconds = 0.0;   // interval to the next frame [s]
};

// Duration, rates and gaps of a series of frames.
struct TimingReport {
  double durationS = 0.0;  // first to last frame [s]
  // 1 / median interval; 1 / mean interval without the gaps when frames came in bursts; 0 with
  // fewer than two frames.
  double rateHz = 0.0;
  bool inBursts = false;  // the median interval is that between frames that arrived together
  // (frames - 1) / duration; 0 with fewer than two frames.
  double meanRateHz = 0.0;
  std::vector<Gap> gaps;  // longer than max(1 s, 5 median intervals)
};

// Computes the report from the frames of a profile.
TimingReport timingOf(const Profile& profile);
// Computes the report from time stamps [us], which must ascend.
TimingReport timingOf(std::span<const std::int64_t> stampsUs);

// A span of time, for charts, sessions and selections. Seconds from the first frame; when two
// recordings are compared, from the first frame of the first recording. fromS <= toS.
struct TimeSpan {
  double fromS = 0.0;
  double toS = 0.0;
  double lengthS() const noexcept { return toS - fromS; }
  bool operator==(const TimeSpan&) const = default;
};

}  // namespace palpate

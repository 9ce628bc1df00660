// How the frames of a profile lie in time: rates and gaps, from the stamps alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <palpate/model/profile.h>

namespace palpate {

// Two neighbouring frames that are too far apart: recording was suspended, or data was lost.
struct Gap {
  std::size_t frame = 0;  // last frame before the gap
  double seconds = 0.0;   // interval to the next frame [s]
};

struct TimingReport {
  double durationS = 0.0;   // first to last frame [s]
  double rateHz = 0.0;      // 1 / median interval; 0 with fewer than two frames
  double meanRateHz = 0.0;  // (frames - 1) / duration; 0 with fewer than two frames
  std::vector<Gap> gaps;    // intervals longer than max(1 s, 5 median intervals)
};

TimingReport timingOf(const Profile& profile);
// From stamps [us], ascending.
TimingReport timingOf(std::span<const std::int64_t> stampsUs);

}  // namespace palpate

// The rest of a sensor, taken of a span of a recording (model/touch.h).
#pragma once

#include <palpate/model/profile.h>

namespace palpate {

// What is taken: the readings that a recording stores, which must be at rest (RestMeter), or the
// values that are seen of it.
enum class RestOf { kReadings, kValues };

struct Rest {
  Baseline baseline;
  std::size_t numFrames = 0;
};

// Of the frames between two times [s after the first frame], both inclusive, with a tolerance of
// 1 ms. Frames that can't be read are left out. Throws std::invalid_argument: not a span, it ends
// after the recording, fewer than two frames are in it, or too many; and Error: not at rest.
Rest restIn(const Profile& profile, double fromS, double toS, RestOf what);

}  // namespace palpate

// Assigns frames to the pictures of a movie. A movie has a constant picture rate, the frames have
// irregular time stamps: a frame is shown by all pictures whose middle lies between its stamp and
// the next one's, which may be none, one or several. The first and the last frame are always shown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <palpate/capture/playback.h>

namespace palpate {

struct MovieOptions {
  static constexpr double kMinPicturesPerS = 1.0;
  static constexpr double kMaxPicturesPerS = 120.0;

  double picturesPerS = 30.0;  // 1..120
  double speed = 1.0;          // 1: as long as it took; Playback::kMinimumSpeed..kMaximumSpeed
};

// One frame, and how many pictures in a row show it.
struct MovieFrame {
  std::size_t frame = 0;  // index into the stamps
  std::size_t numPictures = 1;
  bool operator==(const MovieFrame&) const = default;
};

struct MovieTiming {
  std::vector<MovieFrame> shots;  // ascending; frames that no picture shows are left out
  std::size_t numPictures = 0;
  double seconds = 0.0;     // how long the movie is [s]
  std::size_t numGaps = 0;  // that were shortened
  double shortenedS = 0.0;  // by how much, in the recording's time [s]
};

// The last frame is shown as long as the usual (median) interval. Gaps, longer than max(1 s, 5
// median intervals) (model/timing.h), are shown as that long: nobody watches a still picture for
// minutes. stampsUs: of the frames to be shown [us], ascending; none: no picture. Throws
// std::invalid_argument for options out of range.
MovieTiming movieTiming(std::span<const std::int64_t> stampsUs, const MovieOptions& options = {});

}  // namespace palpate

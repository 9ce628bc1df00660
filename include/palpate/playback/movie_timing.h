// Assigns frames to the pictures of a movie. A movie has a constant picture rate, the frames have
// irregular time stamps: a frame is shown by all pictures whose middle lies between its stamp and
// the next one's, which may be none, one or several. The first and the last frame are always shown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <palpate/core/option_check.h>
#include <palpate/playback/playback.h>

namespace palpate {

struct MovieOptions {
  static constexpr OptionRange kPicturesPerS{1.0, 120.0};
  static constexpr OptionRange kSpeed{Playback::kMinimumSpeed, Playback::kMaximumSpeed};

  double picturesPerS = 30.0;
  // Speed factor; 1: the duration of the recording.
  double speed = 1.0;
};

// One frame and the number of consecutive pictures that show it.
struct MovieFrame {
  std::size_t frame = 0;  // index into the stamps
  std::size_t numPictures = 1;
  bool operator==(const MovieFrame&) const = default;
};

struct MovieTiming {
  // Ascending; frames without a picture are left out.
  std::vector<MovieFrame> shots;
  std::size_t numPictures = 0;
  double seconds = 0.0;     // duration of the movie [s]
  std::size_t numGaps = 0;  // number of shortened gaps
  // Total time removed from gaps, in the recording's time [s].
  double shortenedS = 0.0;
};

// The last frame is shown for the usual (median) interval. Gaps, that is, intervals longer than
// max(1 s, 5 median intervals) (model/timing.h), are shortened to that length, to avoid minutes
// with a still picture. stampsUs: stamps of the frames [us], ascending; if there are none, there is
// no picture. Throws std::invalid_argument for options out of range.
MovieTiming movieTiming(std::span<const std::int64_t> stampsUs, const MovieOptions& options = {});

}  // namespace palpate

#include "palpate/playback/movie_timing.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/time.h"
#include "palpate/model/gap_detector.h"
#include "palpate/model/timing.h"

namespace palpate {
namespace {

void check(const MovieOptions& options) {
  constexpr OptionCheck checked{"MovieOptions"};
  checked(MovieOptions::kPicturesPerS, "picturesPerS", options.picturesPerS);
  checked(MovieOptions::kSpeed, "speed", options.speed);
}

}  // namespace

MovieTiming movieTiming(std::span<const std::int64_t> stampsUs, const MovieOptions& options) {
  check(options);
  MovieTiming movie;
  if (stampsUs.empty()) return movie;
  const TimingReport timing = timingOf(stampsUs);
  const double usualS = timing.rateHz > 0.0 ? 1.0 / timing.rateHz : 0.0;
  const double maxDurationS = gapThresholdS(usualS);
  const double picturesPerRecordedS = options.picturesPerS / options.speed;
  // The first picture whose middle isn't before that time.
  const auto pictureAt = [&](double seconds) {
    // Adds less than a microsecond, so that pictures stay in step with frames of the same rate.
    constexpr double kMiddle = 0.5 + 1e-9;
    return static_cast<std::size_t>(
        std::max(0.0, std::ceil(seconds * picturesPerRecordedS - kMiddle)));
  };
  const std::size_t last = stampsUs.size() - 1;
  auto gap = timing.gaps.begin();
  std::size_t shown = 0;  // number of pictures so far
  for (std::size_t i = 0; i <= last; ++i) {
    if (gap != timing.gaps.end() && gap->frame == i) {
      movie.shortenedS += gap->seconds - maxDurationS;
      ++movie.numGaps;
      ++gap;
    }
    const std::int64_t endUs = stampsUs[std::min(i + 1, last)] - stampsUs.front();
    const double endS = static_cast<double>(endUs) / kUsPerS - movie.shortenedS;
    std::size_t end = pictureAt(i == last ? endS + usualS : endS);
    if (i == 0 || i == last) end = std::max(end, shown + 1);
    if (end <= shown) continue;
    movie.shots.push_back({i, end - shown});
    shown = end;
  }
  movie.numPictures = shown;
  movie.seconds = static_cast<double>(shown) / options.picturesPerS;
  return movie;
}

}  // namespace palpate

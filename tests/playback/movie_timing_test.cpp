#include "palpate/playback/movie_timing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "testing/testing.h"

namespace palpate::movie_timing_test {
namespace {

using Shots = std::vector<MovieFrame>;

std::vector<std::int64_t> everyMs(std::int64_t intervalMs, std::size_t count) {
  std::vector<std::int64_t> stampsUs;
  for (std::size_t i = 0; i < count; ++i)
    stampsUs.push_back(1'400'000'000'000'000 + static_cast<std::int64_t>(i) * intervalMs * 1000);
  return stampsUs;
}

// The index of the frame in each picture.
std::vector<std::size_t> framesOf(const MovieTiming& movie) {
  std::vector<std::size_t> frames;
  for (const MovieFrame& shot : movie.shots)
    frames.insert(frames.end(), shot.numPictures, shot.frame);
  return frames;
}

TEST(MovieTiming, ASlowRecordingRepeatsItsFrames) {
  const MovieTiming movie = movieTiming(everyMs(100, 4), {.picturesPerS = 30.0});
  EXPECT_EQ(movie.shots, (Shots{{0, 3}, {1, 3}, {2, 3}, {3, 3}}));
  EXPECT_EQ(movie.numPictures, 12u);
  EXPECT_DOUBLE_EQ(movie.seconds, 0.4);
}

// A picture covers 100 ms of the recording: the middles are at 50 (but the first frame is always
// shown), 150, 250, 350 ms; and the last frame, at 380 ms, is shown.
TEST(MovieTiming, AFastMovieLeavesFramesOut) {
  const MovieTiming movie = movieTiming(everyMs(20, 20), {.picturesPerS = 20.0, .speed = 2.0});
  EXPECT_EQ(framesOf(movie), (std::vector<std::size_t>{0, 7, 12, 17, 19}));
  EXPECT_DOUBLE_EQ(movie.seconds, 0.25);
}

TEST(MovieTiming, ThirtyASecondInWholeMillisecondsAreThirtyPictures) {
  std::vector<std::int64_t> stampsUs;
  for (int i = 0; i < 3000; ++i)
    stampsUs.push_back(std::llround(static_cast<double>(i) * 1000.0 / 30.0) * 1000);
  const MovieTiming movie = movieTiming(stampsUs);
  ASSERT_EQ(movie.shots.size(), stampsUs.size()) << "none twice, none left out";
  for (const MovieFrame& shot : movie.shots) ASSERT_EQ(shot.numPictures, 1u) << shot.frame;
}

TEST(MovieTiming, SpeedsStretchAndShrink) {
  const auto stampsUs = everyMs(50, 201);  // 10 s, and the last one's 50 ms
  for (const auto& [speed, seconds] :
       {std::pair{0.25, 40.2}, {0.5, 20.1}, {1.0, 10.05}, {2.0, 5.025}, {8.0, 1.25625}}) {
    const MovieTiming movie = movieTiming(stampsUs, {.picturesPerS = 30.0, .speed = speed});
    EXPECT_NEAR(movie.seconds, seconds, 1.0 / 30.0) << speed;
    EXPECT_EQ(framesOf(movie).size(), movie.numPictures);
    EXPECT_EQ(framesOf(movie).front(), 0u);
    EXPECT_EQ(framesOf(movie).back(), 200u);
  }
}

// Compared with the definition, picture by picture: the last frame at or before the middle of the
// picture.
TEST(MovieTiming, IrregularFramesAreShownAtTheirTime) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::int64_t> intervalUs(1'000, 400'000);
  std::vector<std::int64_t> stampsUs = {5'000'000};
  while (stampsUs.size() < 500) stampsUs.push_back(stampsUs.back() + intervalUs(random));
  for (const double speed : {0.3, 1.0, 5.0}) {
    const auto frames = framesOf(movieTiming(stampsUs, {.picturesPerS = 25.0, .speed = speed}));
    for (std::size_t k = 1; k + 1 < frames.size(); ++k) {
      const double middleUs = 5e6 + (static_cast<double>(k) + 0.5) / 25.0 * speed * 1e6;
      const auto after = std::upper_bound(stampsUs.begin(), stampsUs.end(), std::llround(middleUs));
      ASSERT_EQ(frames[k], static_cast<std::size_t>(after - stampsUs.begin()) - 1) << k;
    }
  }
}

TEST(MovieTiming, AGapIsShownAsOneSecond) {
  auto stampsUs = everyMs(100, 10);
  for (std::size_t i = 5; i < 10; ++i) stampsUs[i] += 600'000'000;  // ten minutes
  const MovieTiming movie = movieTiming(stampsUs, {.picturesPerS = 10.0});
  EXPECT_EQ(movie.numGaps, 1u);
  EXPECT_NEAR(movie.shortenedS, 599.1, 1e-9);  // 600.1 s became 1 s
  ASSERT_EQ(movie.shots.size(), 10u);
  EXPECT_EQ(movie.shots[4], (MovieFrame{4, 10}));
  EXPECT_EQ(movie.numPictures, 19u);
  const MovieTiming slow = movieTiming(stampsUs, {.picturesPerS = 10.0, .speed = 0.5});
  EXPECT_EQ(slow.shots[4].numPictures, 20u) << "a second of the recording";
}

TEST(MovieTiming, APauseUpToASecondIsHeldAsItIs) {
  auto stampsUs = everyMs(100, 10);
  for (std::size_t i = 5; i < 10; ++i) stampsUs[i] += 900'000;
  const MovieTiming movie = movieTiming(stampsUs, {.picturesPerS = 10.0});
  EXPECT_EQ(movie.numGaps, 0u);
  EXPECT_EQ(movie.shots[4].numPictures, 10u);
}

TEST(MovieTiming, FramesThatAlwaysComeSlowlyAreNoGaps) {
  const MovieTiming movie = movieTiming(everyMs(3000, 3), {.picturesPerS = 10.0});
  EXPECT_EQ(movie.shots, (Shots{{0, 30}, {1, 30}, {2, 30}}));
  EXPECT_EQ(movie.shortenedS, 0.0);
}

TEST(MovieTiming, FirstAndLastAreSeenHoweverFast) {
  const MovieTiming movie = movieTiming(everyMs(1, 12), {.picturesPerS = 1.0, .speed = 16.0});
  EXPECT_EQ(framesOf(movie), (std::vector<std::size_t>{0, 11}));
}

TEST(MovieTiming, OneFrameIsOnePictureAndNoneIsNone) {
  EXPECT_EQ(movieTiming(everyMs(1, 1)).shots, (Shots{{0, 1}}));
  EXPECT_TRUE(movieTiming({}).shots.empty());
  EXPECT_EQ(movieTiming({}).numPictures, 0u);
}

TEST(MovieTiming, RefusesRatesAndSpeedsThatMakeNoSense) {
  const auto stampsUs = everyMs(10, 3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double rate : {0.0, 0.99, 120.5, -30.0, nan})
    EXPECT_THROW(movieTiming(stampsUs, {.picturesPerS = rate}), std::invalid_argument) << rate;
  for (const double speed : {0.0, 0.09, 16.1, -1.0, nan})
    EXPECT_THROW(movieTiming(stampsUs, {.speed = speed}), std::invalid_argument) << speed;
}

}  // namespace
}  // namespace palpate::movie_timing_test

#include "palpate/playback/playback.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::playback_test {
namespace {

// Frames at the given times [ms].
Playback playbackOf(const std::vector<std::int64_t>& timesMs) {
  const auto layout = std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(1, 1, 1.0)});
  ProfileBuilder builder(layout);
  for (std::int64_t ms : timesMs) builder.addFrame(ms * 1000, std::vector<float>{0.0F});
  return Playback(builder.finish({}));
}

TEST(Playback, FollowsTheRealTimeStamps) {
  Playback playback = playbackOf({1000, 1010, 1100, 1110});  // far from evenly spaced
  playback.advance(50'000);
  EXPECT_EQ(playback.frame(), 0u);  // paused: the position does not change
  playback.play();
  playback.advance(9'999);
  EXPECT_EQ(playback.frame(), 0u);
  playback.advance(1);
  EXPECT_EQ(playback.frame(), 1u);
  playback.advance(89'000);
  EXPECT_EQ(playback.frame(), 1u);
  playback.advance(1'000);
  EXPECT_EQ(playback.frame(), 2u);
  EXPECT_TRUE(playback.playing());
  playback.advance(10'000);
  EXPECT_EQ(playback.frame(), 3u);
  EXPECT_FALSE(playback.playing());  // stops on the last frame
}

TEST(Playback, SpeedsFromATenthToSixteenTimes) {
  Playback playback = playbackOf({0, 100, 200, 3200});
  playback.play();
  playback.setSpeed(0.1);
  for (int i = 0; i < 999; ++i) playback.advance(1'000);
  EXPECT_EQ(playback.frame(), 0u);
  playback.advance(1'000);
  EXPECT_EQ(playback.frame(), 1u);
  EXPECT_EQ(playback.positionUs(), 100'000);  // no fraction was lost
  playback.setSpeed(16.0);
  playback.advance(10'000);
  EXPECT_EQ(playback.positionUs(), 260'000);
  for (double bad : {0.09, 16.1, -1.0, 0.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(playback.setSpeed(bad), std::invalid_argument) << bad;
  EXPECT_EQ(playback.speed(), 16.0);
}

TEST(Playback, LoopShowsTheLastFrameThenStartsOver) {
  Playback playback = playbackOf({0, 10, 20});
  playback.setLoop(true);
  playback.play();
  playback.advance(500'000);
  EXPECT_EQ(playback.frame(), 2u);
  playback.advance(5'000);
  EXPECT_EQ(playback.frame(), 0u);
  EXPECT_TRUE(playback.playing());
  playback.advance(10'000);
  EXPECT_EQ(playback.frame(), 1u);
}

TEST(Playback, SeekingToTheEndWhilePlayingEndsThere) {
  Playback playback = playbackOf({0, 10, 20});
  playback.play();
  playback.seekFrame(2);
  playback.advance(16'000);
  EXPECT_EQ(playback.frame(), 2u);
  EXPECT_FALSE(playback.playing());
}

TEST(Playback, TakingTheLoopAwayOnTheLastFrameEndsThere) {
  Playback playback = playbackOf({0, 10, 20});
  playback.setLoop(true);
  playback.play();
  playback.advance(500'000);
  playback.setLoop(false);
  playback.advance(16'000);
  EXPECT_EQ(playback.frame(), 2u);
  EXPECT_FALSE(playback.playing());
}

TEST(Playback, PlayAtTheEndStartsOver) {
  Playback playback = playbackOf({0, 10, 20});
  playback.seekFrame(2);
  playback.play();
  EXPECT_EQ(playback.frame(), 0u);
  EXPECT_TRUE(playback.playing());
}

TEST(Playback, StepsReachTheFirstAndTheLastFrameAndPause) {
  Playback playback = playbackOf({0, 10, 20, 30});
  playback.play();
  playback.step(1);
  EXPECT_FALSE(playback.playing());
  EXPECT_EQ(playback.frame(), 1u);
  playback.step(-1);
  EXPECT_EQ(playback.frame(), 0u);  // the previous program could never step back to frame 0
  playback.step(-5);
  EXPECT_EQ(playback.frame(), 0u);
  playback.step(std::numeric_limits<std::ptrdiff_t>::max());
  EXPECT_EQ(playback.frame(), 3u);
  playback.step(std::numeric_limits<std::ptrdiff_t>::min());
  EXPECT_EQ(playback.frame(), 0u);
}

TEST(Playback, SeeksToFramesAndTimesClamped) {
  Playback playback = playbackOf({0, 10, 20});
  playback.seekTime(15'000);
  EXPECT_EQ(playback.frame(), 1u);
  EXPECT_EQ(playback.positionUs(), 15'000);
  playback.seekTime(-7);
  EXPECT_EQ(playback.frame(), 0u);
  playback.seekFrame(99);
  EXPECT_EQ(playback.frame(), 2u);
  playback.play();
  playback.seekFrame(1);
  EXPECT_TRUE(playback.playing());  // seeking does not stop playback
}

// A storage in which nothing may be searched for.
class UnsearchedStorage final : public ProfileStorage {
 public:
  std::size_t numFrames() const override { return 100; }
  std::int64_t frameTimeUs(std::size_t i) const override {
    return static_cast<std::int64_t>(i) * 10'000;
  }
  void readFrame(std::size_t, TactileFrame&) const override {}
  std::size_t numSamples(std::size_t) const override { return 0; }
  std::int64_t sampleTimeUs(std::size_t, std::size_t) const override { return 0; }
  Sample sample(std::size_t, std::size_t) const override { return {}; }
  std::optional<std::size_t> frameAt(std::int64_t) const override {
    ADD_FAILURE() << "the frame was searched for";
    return {};
  }
};

TEST(Playback, ASeekToAFrameKnowsItsIndex) {
  const auto layout = std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(1, 1, 1.0)});
  Playback playback(Profile({}, describeHand(*layout, 0, 0), std::make_shared<UnsearchedStorage>()),
                    {});
  for (const std::size_t frame : {70u, 3u, 99u, 0u}) {
    playback.seekFrame(frame);
    EXPECT_EQ(playback.frame(), frame);
    EXPECT_EQ(playback.positionUs(), static_cast<std::int64_t>(frame) * 10'000);
  }
  playback.step(5);
  EXPECT_EQ(playback.frame(), 5u);
}

TEST(Playback, CanJumpOverGaps) {
  Playback playback = playbackOf({0, 30, 60, 60'060, 60'090});
  playback.play();
  playback.advance(70'000);
  EXPECT_EQ(playback.frame(), 2u);  // by default a gap is played in real time
  playback.seekFrame(0);
  playback.setSkipGaps(true);
  playback.advance(60'000);
  EXPECT_EQ(playback.frame(), 2u);
  playback.advance(1'000);
  EXPECT_EQ(playback.frame(), 3u);
}

TEST(Playback, StandsStillWithNothingToPlay) {
  for (Playback playback : {playbackOf({}), playbackOf({77})}) {
    playback.play();
    EXPECT_FALSE(playback.playing());
    playback.step(1);
    playback.seekFrame(5);
    playback.advance(1'000'000);
    EXPECT_EQ(playback.frame(), 0u);
  }
}

}  // namespace
}  // namespace palpate::playback_test

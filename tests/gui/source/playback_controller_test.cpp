#include "gui/source/playback_controller.h"

#include <QSignalSpy>
#include <stdexcept>

#include <gtest/gtest.h>

#include "gui/testing/fake_clock.h"
#include "gui/testing/sample_profiles.h"
#include "testing/testing.h"

namespace palpate::gui::playback_controller_test {
namespace {

class PlaybackControllerTest : public ::testing::Test {
 protected:
  void pass(std::int64_t ms) {
    clock_.advanceMs(ms);
    playback_.tick();
  }
  FakeClock clock_;
  PlaybackController playback_{clock_};
};

TEST_F(PlaybackControllerTest, PlaysByTheRealTimeStamps) {
  playback_.setProfile(profileWithStamps({0, 10, 500, 520}));
  playback_.play();
  pass(9);
  EXPECT_EQ(playback_.frame(), 0u);
  pass(1);
  EXPECT_EQ(playback_.frame(), 1u);
  pass(489);
  EXPECT_EQ(playback_.frame(), 1u);
  pass(1);
  EXPECT_EQ(playback_.frame(), 2u);
  EXPECT_NEAR(playback_.positionS(), 0.5, 1e-9);
  EXPECT_TRUE(playback_.playing());
  pass(20);
  EXPECT_EQ(playback_.frame(), 3u);
  EXPECT_FALSE(playback_.playing()) << "the last frame is the end";
}

TEST_F(PlaybackControllerTest, SkipsFramesWhenItIsLate) {
  playback_.setProfile(twentyFrames());
  QSignalSpy frames(&playback_, &PlaybackController::frameChanged);
  playback_.play();
  pass(500);
  EXPECT_EQ(playback_.frame(), 10u);
  ASSERT_EQ(frames.size(), 1);
  EXPECT_EQ(frames[0][0].value<std::size_t>(), 10u);
}

TEST_F(PlaybackControllerTest, TellsPositionBetweenFramesWithoutRepeatingTheFrame) {
  playback_.setProfile(twentyFrames());
  playback_.play();
  QSignalSpy frames(&playback_, &PlaybackController::frameChanged);
  QSignalSpy positions(&playback_, &PlaybackController::positionChanged);
  pass(16);
  pass(16);
  EXPECT_EQ(frames.size(), 0);
  ASSERT_EQ(positions.size(), 2);
  EXPECT_NEAR(positions[1][0].toDouble(), 0.032, 1e-9);
}

TEST_F(PlaybackControllerTest, SpeedCountsFromNowOn) {
  playback_.setProfile(profileWithStamps({0, 1000, 2000, 3000, 4000}));
  playback_.play();
  clock_.advanceMs(1000);
  playback_.setSpeed(2.0);
  EXPECT_NEAR(playback_.positionS(), 1.0, 1e-9);
  pass(1000);
  EXPECT_NEAR(playback_.positionS(), 3.0, 1e-9);
  EXPECT_THROW(playback_.setSpeed(0.05), std::invalid_argument);
  EXPECT_EQ(playback_.speed(), 2.0);
}

TEST_F(PlaybackControllerTest, FasterAndSlowerGoThroughTheOfferedSpeeds) {
  std::vector<double> seen;
  for (int i = 0; i < 6; ++i) {
    playback_.faster();
    seen.push_back(playback_.speed());
  }
  EXPECT_EQ(seen, (std::vector<double>{2, 4, 8, 16, 16, 16}));
  for (int i = 0; i < 9; ++i) playback_.slower();
  EXPECT_EQ(playback_.speed(), 0.1);
  playback_.setSpeed(3.0);
  playback_.slower();
  EXPECT_EQ(playback_.speed(), 2.0);
  playback_.setSpeed(3.0);
  playback_.faster();
  EXPECT_EQ(playback_.speed(), 4.0);
}

TEST_F(PlaybackControllerTest, LoopStartsOverAndShowsTheLastFrame) {
  playback_.setProfile(profileWithStamps({0, 100, 200}));
  playback_.setLoop(true);
  playback_.play();
  pass(5000);
  EXPECT_EQ(playback_.frame(), 2u);
  pass(16);
  EXPECT_EQ(playback_.frame(), 0u);
  EXPECT_TRUE(playback_.playing());
}

TEST_F(PlaybackControllerTest, SkipsGapsOnlyWhenAsked) {
  const Profile gap = profileWithStamps({0, 100, 200, 60'200, 60'300});
  playback_.setProfile(gap);
  playback_.play();
  pass(300);
  EXPECT_EQ(playback_.frame(), 2u);
  playback_.seekFrame(0);
  playback_.setSkipGaps(true);
  pass(300);
  EXPECT_EQ(playback_.frame(), 3u);
}

TEST_F(PlaybackControllerTest, StepPausesAndIsClamped) {
  playback_.setProfile(twentyFrames());
  playback_.play();
  playback_.step(3);
  EXPECT_FALSE(playback_.playing());
  EXPECT_EQ(playback_.frame(), 3u);
  playback_.step(-10);
  EXPECT_EQ(playback_.frame(), 0u);
  playback_.step(100);
  EXPECT_EQ(playback_.frame(), 19u);
}

TEST_F(PlaybackControllerTest, SeeksByFrameAndTime) {
  playback_.setProfile(twentyFrames());
  playback_.seekFrame(7);
  EXPECT_NEAR(playback_.positionS(), 0.35, 1e-9);
  playback_.seekSeconds(0.51);
  EXPECT_EQ(playback_.frame(), 10u);
  playback_.seekSeconds(-3.0);
  EXPECT_EQ(playback_.frame(), 0u);
  playback_.seekSeconds(1e300);
  EXPECT_EQ(playback_.frame(), 19u);
  playback_.seekSeconds(std::nan(""));
  EXPECT_EQ(playback_.frame(), 19u);
}

TEST_F(PlaybackControllerTest, PlayAtTheEndStartsOver) {
  playback_.setProfile(twentyFrames());
  playback_.seekFrame(19);
  playback_.togglePlay();
  EXPECT_TRUE(playback_.playing());
  EXPECT_EQ(playback_.frame(), 0u);
  playback_.togglePlay();
  EXPECT_FALSE(playback_.playing());
}

TEST_F(PlaybackControllerTest, WithoutFramesNothingHappens) {
  for (const auto& profile : {std::optional<Profile>(), std::optional(profileWithStamps({}))}) {
    playback_.setProfile(profile);
    playback_.play();
    playback_.step(1);
    playback_.seekFrame(3);
    playback_.seekSeconds(1.0);
    pass(100);
    EXPECT_FALSE(playback_.playing());
    EXPECT_EQ(playback_.frame(), 0u);
    EXPECT_EQ(playback_.positionS(), 0.0);
    EXPECT_EQ(playback_.durationS(), 0.0);
  }
}

TEST_F(PlaybackControllerTest, SettingsStayWithTheNextRecording) {
  playback_.setSpeed(4.0);
  playback_.setLoop(true);
  playback_.setProfile(profileWithStamps({0, 100, 200}));
  playback_.play();
  pass(25);
  EXPECT_EQ(playback_.frame(), 1u) << "speed 4";
  pass(100);
  pass(1);
  EXPECT_TRUE(playback_.playing()) << "loops";
}

}  // namespace
}  // namespace palpate::gui::playback_controller_test

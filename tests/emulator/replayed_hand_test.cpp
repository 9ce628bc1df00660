#include "palpate/emulator/replayed_hand.h"

#include <algorithm>

#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::replayed_hand_test {
namespace {

std::vector<std::uint16_t> scanOf(ReplayedHand& hand) {
  std::vector<std::uint16_t> counts(hand.hand().layout->numCells());
  hand.scan(counts);
  return counts;
}

Profile sample() { return synthesize({.durationS = 2.0, .grasps = 1, .noiseCounts = 5.0}); }

TEST(ReplayedHand, GivesEachFrameOnceAndInOrderAtItsIntervals) {
  const Profile profile = sample();
  ReplayedHand hand(profile);
  EXPECT_EQ(hand.nextIntervalS(), 0.0);
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    ASSERT_FALSE(hand.finished());
    if (i > 0) {
      EXPECT_DOUBLE_EQ(*hand.nextIntervalS(),
                       double(profile.frameTimeUs(i) - profile.frameTimeUs(i - 1)) * 1e-6);
    }
    const auto counts = scanOf(hand);
    const TactileFrame frame = profile.frame(i);
    for (std::size_t k = 0; k < counts.size(); ++k)
      ASSERT_EQ(float(counts[k]), frame.values[k]) << "frame " << i << " place " << k;
  }
  EXPECT_TRUE(hand.finished());
  EXPECT_FALSE(hand.nextIntervalS());
  for (const std::uint16_t count : scanOf(hand)) EXPECT_EQ(count, 0);
}

TEST(ReplayedHand, JointsAndTemperaturesAreThoseOfTheMoment) {
  const Profile profile = sample();
  ReplayedHand hand(profile);
  double timeS = 10.0;  // the client waits
  hand.advanceTo(timeS);
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    hand.advanceTo(timeS += hand.nextIntervalS().value());
    scanOf(hand);
    const auto angles = profile.anglesAtFrame(i);
    const auto temperatures = profile.temperaturesAtFrame(i);
    ASSERT_TRUE(angles && temperatures);
    for (std::size_t axis = 0; axis < 7; ++axis)
      ASSERT_NEAR(hand.joints().angles()[axis], angles->values[axis], 1e-9) << "frame " << i;
    ASSERT_EQ(hand.temperatures(), temperatures->values);
  }
}

TEST(ReplayedHand, TimeStandsStillBetweenStreamsAndSettingsStay) {
  const Profile profile = sample();
  ReplayedHand hand(profile);
  scanOf(hand);
  scanOf(hand);
  hand.joints().setPower(std::vector<bool>(7, true));
  hand.joints().setController(ControllerType::kVelocity);
  hand.advanceTo(1000.0);
  const auto third = profile.angleSampleAt(profile.frameTimeUs(2));
  EXPECT_NEAR(hand.joints().angles()[1], profile.angles(*third).values[1], 1e-9);
  EXPECT_EQ(hand.joints().power(), std::vector<bool>(7, true));
  EXPECT_EQ(hand.joints().controller(), ControllerType::kVelocity);
  hand.advanceTo(5.0);  // an earlier time has no effect
  EXPECT_DOUBLE_EQ(hand.timeS(), 1000.0);
}

TEST(ReplayedHand, MasksAreAppliedThresholdsAreNot) {
  Profile profile = sample();
  std::size_t touched = 0;
  for (std::size_t i = 0; i < profile.numFrames() && touched == 0; ++i) {
    const TactileFrame frame = profile.frame(i);
    if (frame.matrix(1).maxCoeff() > 0.0F) touched = i;
  }
  ASSERT_GT(touched, 0u);
  ReplayedHand hand(profile);
  hand.settings()[1].thresholdCounts = 4095;
  while (hand.nextFrame() < touched) scanOf(hand);
  const auto open = scanOf(hand);
  EXPECT_GT(*std::max_element(open.begin() + 84, open.begin() + 162), 0);
  hand.settings()[1].dynamicMask.assign(78, 0);
  const auto masked = scanOf(hand);
  EXPECT_EQ(*std::max_element(masked.begin() + 84, masked.begin() + 162), 0);
  EXPECT_TRUE(hand.truth().empty());
}

TEST(ReplayedHand, PlaysARealRecording) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  const Profile profile = openRecording(*folder / "grasps" / "hockey_ball.dsa");
  ReplayedHand hand(profile);
  double sentSum = 0.0, recordedSum = 0.0;
  std::size_t frames = 0;
  while (!hand.finished()) {
    for (const std::uint16_t count : scanOf(hand)) sentSum += count;
    for (const float value : profile.frame(frames).values) recordedSum += double(value);
    ++frames;
  }
  EXPECT_EQ(frames, profile.numFrames());
  EXPECT_EQ(sentSum, recordedSum);
}

}  // namespace
}  // namespace palpate::replayed_hand_test

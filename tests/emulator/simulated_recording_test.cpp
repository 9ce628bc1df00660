#include "palpate/emulator/simulated_recording.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/default_scene.h"
#include "palpate/model/hand_file.h"

#include "testing/testing.h"

namespace palpate::simulated_recording_test {
namespace {

Scene emptyPinch() {
  Scene scene;
  scene.preshape = "pinch-empty";
  scene.script = {{1.0, GraspAction{std::nullopt, 1.0, 40.0}}};
  return scene;
}

double sumOf(const TactileFrame& frame, std::size_t matrix) {
  return frame.matrix(matrix).cast<double>().sum();
}

TEST(SimulatedRecording, HasFramesAnglesAndTemperaturesAtTheirTimes) {
  SimulatedRecordingOptions options;
  options.durationS = 3.0;
  const Profile profile =
      simulateRecording(loadScene("ball", testing::dataFolder() / "scenes"), options);
  EXPECT_EQ(profile.numFrames(), 96u);  // 0, 31.5, .. 2992.5 ms
  EXPECT_EQ(profile.frameTimeUs(2) - profile.frameTimeUs(0), 63'000);
  EXPECT_EQ(profile.numAngles(), 477u);
  EXPECT_EQ(profile.numTemperatures(), 4u);
  EXPECT_EQ(profile.frameTimeUs(0), options.startUs);
}

TEST(SimulatedRecording, IsTheSameForTheSameSeed) {
  const Scene scene = emptyPinch();
  SimulatedRecordingOptions options;
  options.durationS = 8.0;
  const auto lastOf = [&](std::uint64_t seed) {
    options.hand.seed = seed;
    const Profile profile = simulateRecording(scene, options);
    return profile.frame(profile.numFrames() - 1).values;
  };
  EXPECT_EQ(lastOf(3), lastOf(3));
  EXPECT_NE(lastOf(3), lastOf(4));
}

// The flat fingertips of the empty hand meet at proximal joint angles of asin(36.4 / 173) = 12.15
// degrees. Before that no taxel is active; then both pads measure the same, and the fingers are
// stopped before their target (15 degrees).
TEST(SimulatedRecording, PadsOfAnEmptyHandTouchEachOther) {
  SimulatedRecordingOptions options;
  options.durationS = 10.0;
  const Profile profile = simulateRecording(emptyPinch(), options);
  const double meetDeg = std::asin(36.4 / 173.0) * 180.0 / std::numbers::pi;
  bool touched = false;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    const TactileFrame frame = profile.frame(i);
    const double first = sumOf(frame, 1), second = sumOf(frame, 5);
    if (profile.anglesAtFrame(i)->values[1] < meetDeg - 0.05) {
      EXPECT_EQ(first + second, 0.0) << i;
    }
    touched = touched || (first > 0.0 && second > 0.0);
    EXPECT_EQ(sumOf(frame, 0) + sumOf(frame, 2) + sumOf(frame, 3) + sumOf(frame, 4), 0.0);
  }
  EXPECT_TRUE(touched);
  const TactileFrame last = profile.frame(profile.numFrames() - 1);
  EXPECT_NEAR(sumOf(last, 5), sumOf(last, 1), 0.1 * sumOf(last, 1));
  EXPECT_GT(profile.anglesAtFrame(profile.numFrames() - 1)->values[1], meetDeg);
  EXPECT_LT(profile.anglesAtFrame(profile.numFrames() - 1)->values[1], 14.5);
}

TEST(SimulatedRecording, ThePadsTruthIsContactWithoutSlip) {
  PhysicalHand hand(emptyPinch(), {});
  hand.advanceTo(9.0);
  std::vector<std::uint16_t> counts(sdh2().layout->numCells());
  hand.scan(counts);
  const auto truth = hand.truth();
  EXPECT_TRUE(truth[1].contact);
  EXPECT_GT(truth[1].forceN, 5.0);
  EXPECT_NEAR(truth[5].forceN, truth[1].forceN, 0.02 * truth[1].forceN);
  EXPECT_NEAR(truth[1].yMm, 0.0, 0.5) << "in the middle between the fingers";
  EXPECT_EQ(truth[1].slipXTaxels, 0.0);
  EXPECT_FALSE(truth[3].contact);
}

// A joint whose true angle is one degree larger than reported is stopped one degree earlier.
TEST(SimulatedRecording, AZeroErrorOfTheJointsShowsInWhatTheyReport) {
  SimulatedRecordingOptions options;
  options.durationS = 30.0;
  const auto stopDeg = [&] {
    const Profile profile = simulateRecording(emptyPinch(), options);
    return profile.angles(profile.numAngles() - 1).values[1];
  };
  const double without = stopDeg();
  options.hand.zeroErrorDeg = {0, 1, -1, 0, 0, 1, -1};
  EXPECT_NEAR(stopDeg(), without - 1.0, 0.35) << "squeezed a little more: more of the way is left";
  options.hand.zeroErrorDeg = {1};
  EXPECT_THROW(stopDeg(), std::invalid_argument);
}

TEST(SimulatedRecording, GraspsFollowEachOtherAndDiffer) {
  const Scene pen = loadScene("pen", testing::dataFolder() / "scenes");
  const Scene a = variedScene(pen, {}, 1), again = variedScene(pen, {}, 1),
              b = variedScene(pen, {}, 2);
  EXPECT_EQ(a.objects[0].positionMm, again.objects[0].positionMm);
  EXPECT_NE(a.objects[0].positionMm, b.objects[0].positionMm);
  EXPECT_LT((a.objects[0].positionMm - pen.objects[0].positionMm).norm(), 15.0);
  EXPECT_NEAR(a.objects[0].rotation.determinant(), 1.0, 1e-9);
  EXPECT_EQ(variedScene(pen, {0.0, 0.0, 0.0, 0.0}, 5).objects[0].positionMm,
            pen.objects[0].positionMm);
  const Profile profile = simulateGrasps(pen, 3);
  std::size_t begun = 0;
  bool before = false;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    const TactileFrame frame = profile.frame(i);
    const bool touches = sumOf(frame, 1) > 0.0 && sumOf(frame, 5) > 0.0;
    begun += touches && !before ? 1 : 0;
    before = touches;
  }
  EXPECT_EQ(begun, 3u);
  EXPECT_THROW(simulateGrasps(pen, 0), std::invalid_argument);
  EXPECT_THROW(variedScene(pen, {-1.0, 0.0, 0.0, 0.0}, 1), std::invalid_argument);
}

TEST(SimulatedRecording, IsOneOfAnyHand) {
  const HandDescription& sole = builtInHand("sole");
  SimulatedRecordingOptions options;
  options.durationS = 3.0;
  options.hand.hand = sole;
  const Profile profile = simulateRecording(defaultScene(sole), options);
  EXPECT_EQ(profile.hand().name, sole.name);
  EXPECT_EQ(profile.layout().numCells(), 384u);
  EXPECT_EQ(profile.numFrames(), 96u);
  const TactileFrame frame = profile.frame(60);  // at 1.89 s the sphere presses
  EXPECT_GT(*std::max_element(frame.values.begin(), frame.values.end()), 200.0F);
  EXPECT_LE(*std::max_element(frame.values.begin(), frame.values.end()), 600.0F);
}

TEST(SimulatedRecording, ASkinWithThreeComponentsHasReadingsOverItsBaseline) {
  SimulatedRecordingOptions options;
  options.durationS = 3.0;
  options.hand.hand = parseHand(
      R"({"format": "palpate-hand", "version": 1, "name": "skin", "full_scale": 1000,
          "components": 3, "signed": true, "touch_threshold": 20,
          "matrices": [{"name": "pad", "rows": 6, "columns": 6, "pitch_mm": 4.0}]})",
      "",
      "hand.json");
  const Profile profile = simulateGrasps(defaultScene(options.hand.hand), 2, {}, options);
  ASSERT_TRUE(profile.givesReadings());
  ASSERT_EQ(profile.baselines().size(), 2u) << "each run has sensors of its own";
  EXPECT_NE(*profile.baselines()[0].second, *profile.baselines()[1].second);
  const TactileFrame rest = profile.frame(0);
  EXPECT_EQ(rest.readings.size(), 108u);
  EXPECT_EQ(*std::max_element(rest.values.begin(), rest.values.end()), 0.0F);
  float largest = 0.0F;
  for (std::size_t i = 0; i < profile.numFrames(); ++i)
    for (const float value : profile.frame(i).values) largest = std::max(largest, value);
  EXPECT_GT(largest, 200.0F) << "the object presses";
}

TEST(SimulatedRecording, WrongQuestionsAreRefused) {
  SimulatedRecordingOptions options;
  options.durationS = 0.0;
  EXPECT_THROW(simulateRecording(Scene{}, options), std::invalid_argument);
  options = {};
  options.frameIntervalS = std::nan("");
  EXPECT_THROW(options.validate(), std::invalid_argument);
  EXPECT_THROW(simulateRecording(emptyPinch(), {}, [](double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace palpate::simulated_recording_test

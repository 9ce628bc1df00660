#include "palpate/recognition/empty_hand.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/emulator/simulated_recording.h"
#include "palpate/recognition/grasp_features.h"
#include "palpate/recognition/plateau_features.h"

#include "recognition/pinch_profile.h"
#include "testing/sdh2.h"
#include "testing/testing.h"

namespace palpate::empty_hand_test {
namespace {

using testing::pinchProfile;
using testing::PinchStep;

// The pads of an empty hand touch `touches` times for 30 frames, each with 1000 counts; the
// distance computed from the joints is `gapMm`.
Profile touches(int count, double gapMm, double stepMm = 0.0) {
  std::vector<PinchStep> steps(10, {gapMm + 10.0});
  for (int i = 0; i < count; ++i) {
    steps.insert(steps.end(), 30, {gapMm + i * stepMm, 1000.0F, 1000.0F});
    steps.insert(steps.end(), 10, {gapMm + 10.0});
  }
  return pinchProfile(steps);
}

TEST(EmptyHand, WhatTheJointsSayWhileThePadsTouchIsTheZero) {
  const EmptyHandZero zero = emptyHandZero(touches(1, -3.0));
  ASSERT_EQ(zero.problem, "");
  EXPECT_NEAR(zero.foamMm, 1.6, 1e-9) << "0.8 mm on each side";
  EXPECT_NEAR(zero.mm, -3.0 + 1.6, 1e-6);
  EXPECT_EQ(zero.touches, 1u);
  EXPECT_NEAR(zero.sdMm, 0.25, 1e-12);
  // Several touches give their mean; their own scatter is used if it is larger than the known one.
  const EmptyHandZero three = emptyHandZero(touches(3, -3.0, 1.0));
  EXPECT_NEAR(three.mm, -2.0 + 1.6, 1e-6);
  EXPECT_NEAR(three.sdMm, 1.0 / std::sqrt(3.0), 1e-6);
}

TEST(EmptyHand, TheDifferenceOfTwoDaysIsTheOffset) {
  const SessionOffset offset =
      emptyHandOffset(emptyHandZero(touches(2, -5.0)), emptyHandZero(touches(2, -1.0)));
  EXPECT_NEAR(offset.mm, -4.0, 1e-6);
  EXPECT_NEAR(offset.sdMm, std::hypot(0.25, 0.6), 1e-9)
      << "two times .25 / sqrt 2, and .15 of the 4 mm";
  EXPECT_EQ(offset.origin, OffsetSource::kEmptyHand);
  EXPECT_TRUE(offset.trusted);
  // With more force than in training the error of the foam model has an effect: half of .8 * 2
  // (sqrt 2 - 1).
  EmptyHandZero harder = emptyHandZero(touches(2, -5.0));
  harder.foamMm = 1.6 * std::sqrt(2.0);
  const double foam = 0.5 * 1.6 * (std::sqrt(2.0) - 1.0);
  EXPECT_NEAR(emptyHandOffset(harder, emptyHandZero(touches(2, -1.0))).sdMm,
              std::hypot(0.25, 0.6, foam),
              1e-9);
}

TEST(EmptyHand, WhatIsNoTouchIsSaid) {
  EXPECT_EQ(emptyHandZero(touches(0, 0.0)).problem,
            "no touch: the pads never touch for more than 20 frames in a row");
  EXPECT_EQ(emptyHandZero(touches(1, 30.0)).problem,
            "the pads seem to be 31.6 mm apart while they touch: the hand isn't empty, or its "
            "joints are far off");
  EXPECT_EQ(emptyHandZero(pinchProfile({30, {0.0, 100.0F, 100.0F}}, false)).problem,
            "no joint angles");
  EXPECT_NE(emptyHandZero(testing::otherSensorProfile(30)).problem, "");
  EXPECT_THROW(emptyHandOffset(EmptyHandZero{}, emptyHandZero(touches(1, 0.0))),
               std::invalid_argument);
  EXPECT_THROW(emptyHandZero(touches(1, 0.0), {}, [](double) { return false; }), Cancelled);
  EmptyHandOptions options;
  options.touchSdMm = 0.0;
  EXPECT_THROW(options.validate(), std::invalid_argument);
}

TEST(EmptyHand, TravelsThroughAFile) {
  EmptyHandZero zero = emptyHandZero(touches(2, -3.0, 0.1));
  zero.origin = "zero.dsa";
  zero.sha256 = "00ff";
  const EmptyHandZero back = emptyHandZeroFrom(Json::parse(emptyHandZeroJson(zero).text()));
  EXPECT_EQ(back.mm, zero.mm);
  EXPECT_EQ(back.sdMm, zero.sdMm);
  EXPECT_EQ(back.foamMm, zero.foamMm);
  EXPECT_EQ(back.touches, zero.touches);
  EXPECT_EQ(back.timeUs, testing::kPinchStartUs + 10 * testing::kPinchPeriodUs) << "of the first";
  EXPECT_EQ(back.origin, "zero.dsa");
  EXPECT_EQ(back.sha256, "00ff");
  EXPECT_EQ(back.text(), "-1.3 mm (+- 0.2 mm, 2 touches, zero.dsa)");
  // A model of format 1 has fewer fields.
  const EmptyHandZero old =
      emptyHandZeroFrom(Json::parse(R"({"mm":1,"sd_mm":0.2,"foam_mm":1.6,"touches":1})"));
  EXPECT_EQ(old.timeUs, 0);
  EXPECT_EQ(old.origin, "");
  EXPECT_THROW(emptyHandZeroFrom(emptyHandZeroJson(zero).set("origin", 3)), Error);
  EXPECT_THROW(emptyHandZeroFrom(Json::object()), Error);
  EXPECT_THROW(emptyHandZeroFrom(emptyHandZeroJson(zero).set("sd_mm", 0.0)), Error);
}

// The joints of the emulated hand have a wrong zero in this session: one touch of the empty hand
// gives the error of the sizes.
TEST(EmptyHand, OneTouchOfTheEmulatedHandTellsTheOffsetOfTheDay) {
  Scene empty, pinch;
  empty.preshape = "pinch-empty";
  empty.script = {{0.5, GraspAction{std::nullopt, 1.0, 20.0}}};
  SceneObject cylinder;
  cylinder.shape = {ShapeKind::kCylinder, {40.0, 40.0, 120.0}};
  cylinder.positionMm = {19.05, 0.0, 150.0};
  pinch.objects = {cylinder};
  pinch.preshape = "pinch-parallel";
  pinch.script = {{0.5, GraspAction{std::nullopt, 1.0, 20.0}}};
  const auto sizeOf = [&](const SimulatedRecordingOptions& day) {
    const Profile profile = simulateRecording(pinch, day);
    const auto grasps = findPinches(profile, FeatureSet::kBest);
    EXPECT_EQ(grasps.size(), 1u);
    return grasps.empty() ? 0.0 : plateauFeatures(profile, grasps[0], sdh2PinchHand()).distanceMm;
  };
  SimulatedRecordingOptions training;
  training.durationS = 9.0;
  const EmptyHandZero before = emptyHandZero(simulateRecording(empty, training));
  ASSERT_EQ(before.problem, "");
  const double trueMm = sizeOf(training);
  for (const double errorDeg : {-1.5, 0.8}) {
    SimulatedRecordingOptions today = training;
    today.hand.seed = 9;
    today.hand.zeroErrorDeg = {0, errorDeg, 0, 0, 0, errorDeg, 0};
    const EmptyHandZero zero = emptyHandZero(simulateRecording(empty, today));
    ASSERT_EQ(zero.problem, "");
    const SessionOffset offset = emptyHandOffset(zero, before);
    const double offMm = sizeOf(today) - trueMm;
    EXPECT_GT(std::abs(offMm), 1.5) << "the day differs";
    EXPECT_NEAR(offset.mm, offMm, 2.0 * offset.sdMm) << errorDeg;
    EXPECT_LT(offset.sdMm, 1.0) << errorDeg;
    EXPECT_TRUE(offset.trusted);
  }
}

}  // namespace
}  // namespace palpate::empty_hand_test

#include "palpate/slip/slip_tracker.h"

#include <cmath>

#include "slip_scene.h"
#include "testing/counted_allocations.h"
#include "testing/testing.h"

namespace palpate::slip_tracker_test {
namespace {

using testing::reading;
using testing::viewOf;

std::vector<SlipMethod> methods() {
  std::vector<SlipMethod> all(slipMethods().begin(), slipMethods().end());
  std::erase(all, SlipMethod::kContest);
  return all;
}

SlipTracker trackerOf(SlipMethod method,
                      const MatrixLayout& layout = MatrixLayout::full(14, 6, 3.4)) {
  SlipTrackerOptions options;
  options.method = method;
  return SlipTracker(layout, options);
}

// An oblique bar over taxels that are twice as high as wide: its axis lies at atan(2) instead of
// 45 deg, and no method measures a rotation.
TEST(SlipTracker, NoRotationOfTaxelsThatArentSquare) {
  for (const SlipMethod method : methods()) {
    SlipTracker tracker = trackerOf(method, MatrixLayout::full(14, 6, {2.0, 4.0}));
    MatrixValues bar = MatrixValues::Zero(14, 6);
    for (int i = 1; i < 5; ++i) bar(i + 3, i) = 500.0F;
    SlipMotion motion;
    for (int i = 0; i < 3; ++i) motion = tracker.update(ConstMatrixMap(bar.data(), 14, 6));
    EXPECT_NEAR(motion.rotation.axis.orientationDeg, 63.4349488, 1e-6);
    EXPECT_FALSE(motion.rotation.reliable);
    EXPECT_FALSE(motion.rotation.valid);
    EXPECT_FALSE(motion.rotation.refValid);
  }
}

// Largest error of a method over a path of about one taxel, and in a step [taxels]; the
// correlations are biased.
double allowance(SlipMethod method) {
  switch (method) {
    case SlipMethod::kRegister:
      return 0.03;
    case SlipMethod::kPhaseNormalized:
      return 0.7;  // noise of every frequency
    default:
      return 0.12;
  }
}

TEST(SlipTracker, FollowsASteadySlipByEveryMethod) {
  for (const SlipMethod method : methods()) {
    SyntheticSensor sensor;
    SyntheticSlip slip(sensor, 4);
    SlipTracker tracker = trackerOf(method);
    SyntheticContact contact;
    contact.shape = SlipShape::kEllipticGaussian;
    contact.y = 6.0;
    for (int i = 0; i <= 12; ++i) {
      contact.y = 6.0 + 0.1 * i;
      contact.x = 2.4 + 0.02 * i;
      const SlipMotion& motion = tracker.update(viewOf(reading(slip, contact)));
      EXPECT_EQ(motion.valid, i > 0) << nameOf(method);
      EXPECT_TRUE(motion.refValid) << nameOf(method);
      EXPECT_NEAR(motion.refDy, 0.1 * i, allowance(method)) << nameOf(method) << " " << i;
      EXPECT_NEAR(motion.refDx, 0.02 * i, allowance(method)) << nameOf(method) << " " << i;
      if (i == 0) continue;
      EXPECT_NEAR(motion.dy, 0.1, method == SlipMethod::kPhaseNormalized ? 0.4 : 0.1)
          << nameOf(method);
      EXPECT_GT(motion.confidence, 0.2) << nameOf(method);
    }
  }
}

TEST(SlipTracker, NothingTouchedIsNothingMoved) {
  const MatrixValues nothing = MatrixValues::Zero(14, 6);
  for (const SlipMethod method : methods()) {
    SlipTracker tracker = trackerOf(method);
    for (int i = 0; i < 3; ++i) {
      const SlipMotion& motion = tracker.update(viewOf(nothing));
      EXPECT_EQ(motion.active, 0);
      EXPECT_FALSE(motion.valid || motion.refValid || motion.rotation.reliable || motion.touched);
      EXPECT_EQ(motion.confidence, 0.0);
    }
  }
}

TEST(SlipTracker, OneTaxelIsNoContactThatCouldMove) {
  MatrixValues one = MatrixValues::Zero(14, 6);
  one(4, 2) = 700.0F;
  for (const SlipMethod method : methods()) {
    SlipTracker tracker = trackerOf(method);
    EXPECT_TRUE(tracker.update(viewOf(one)).touched);
    const SlipMotion& motion = tracker.update(viewOf(one));
    EXPECT_EQ(motion.active, 1);
    EXPECT_FALSE(motion.valid) << nameOf(method);
    EXPECT_FALSE(motion.refValid) << nameOf(method);
  }
}

TEST(SlipTracker, ContactLostAndRegainedKeepsTheReferenceAndHasNoStep) {
  SyntheticSlip slip({}, 9);
  const MatrixValues nothing = MatrixValues::Zero(14, 6);
  for (const SlipMethod method : methods()) {
    SlipTracker tracker = trackerOf(method);
    SyntheticContact contact;
    contact.shape = SlipShape::kEllipticGaussian;
    tracker.update(viewOf(reading(slip, contact)));
    tracker.update(viewOf(reading(slip, contact)));
    EXPECT_FALSE(tracker.update(viewOf(nothing)).refValid);
    contact.y += 0.4;
    SlipMotion motion = tracker.update(viewOf(reading(slip, contact)));
    EXPECT_TRUE(motion.touched);
    EXPECT_FALSE(motion.valid) << nameOf(method);
    EXPECT_TRUE(motion.refValid) << nameOf(method);
    EXPECT_NEAR(motion.refDy, 0.4, 0.4 * allowance(method) + 0.05) << nameOf(method);
    motion = tracker.update(viewOf(reading(slip, contact)));
    EXPECT_TRUE(motion.valid) << nameOf(method);
    EXPECT_FALSE(motion.touched);
    EXPECT_NEAR(motion.dy, 0.0, 0.05) << nameOf(method);
  }
}

TEST(SlipTracker, FramesThatAreMissingLeaveNoStep) {
  SyntheticSlip slip({}, 9);
  for (const SlipMethod method : methods()) {
    SlipTracker tracker = trackerOf(method);
    SyntheticContact contact;
    tracker.update(viewOf(reading(slip, contact)));
    const SlipMotion& motion = tracker.update(viewOf(reading(slip, contact)), true);
    EXPECT_TRUE(motion.afterGap);
    EXPECT_FALSE(motion.valid) << nameOf(method);
    EXPECT_TRUE(motion.refValid) << nameOf(method);
    EXPECT_FALSE(motion.rotation.valid) << nameOf(method);
  }
}

TEST(SlipTracker, ReferenceIsSetClearedAndAwaited) {
  SyntheticSlip slip({}, 9);
  const MatrixValues nothing = MatrixValues::Zero(14, 6);
  for (const SlipMethod method : methods()) {
    SlipTrackerOptions options;
    options.method = method;
    options.firstContactIsReference = false;
    SlipTracker tracker(slip.sensor().layout, options);
    SyntheticContact contact;
    contact.shape = SlipShape::kFlatEllipse;
    EXPECT_FALSE(tracker.update(viewOf(reading(slip, contact))).refValid) << nameOf(method);
    tracker.setReference();
    EXPECT_TRUE(tracker.last().refValid);
    contact.y += 0.2;
    EXPECT_NEAR(tracker.update(viewOf(reading(slip, contact))).refDy, 0.2, 0.11) << nameOf(method);
    tracker.setReference();
    EXPECT_NEAR(tracker.update(viewOf(reading(slip, contact))).refDy, 0.0, 0.05) << nameOf(method);
    tracker.clearReference();
    EXPECT_FALSE(tracker.update(viewOf(reading(slip, contact))).refValid);
    tracker.update(viewOf(nothing));
    tracker.setReference();  // awaits contact
    const SlipMotion motion = tracker.update(viewOf(reading(slip, contact)));
    EXPECT_TRUE(motion.refValid) << nameOf(method);
    EXPECT_NEAR(motion.refDy, 0.0, 1e-9) << nameOf(method);
  }
}

TEST(SlipTracker, RegisterTurnsWithTheContactOverWholeTurns) {
  SyntheticSlip slip({}, 2);
  SlipTracker tracker = trackerOf(SlipMethod::kRegister);
  SyntheticContact contact;
  contact.shape = SlipShape::kTwoBlobs;
  for (int i = 0; i <= 100; ++i) {
    contact.angleDeg = 4.0 * i;  // to 400 degrees
    const SlipMotion& motion = tracker.update(viewOf(reading(slip, contact)));
    EXPECT_TRUE(motion.rotation.refValid);
    // Every new key frame adds an error of some tenths of a degree.
    EXPECT_NEAR(motion.rotation.refRotationDeg, 4.0 * i, 8.0) << i;
    EXPECT_NEAR(motion.rotation.rotationDeg, i > 0 ? 4.0 : 0.0, 2.0) << i;
  }
}

TEST(SlipTracker, RegisterRenewsItsKeyOverALongWay) {
  SyntheticSensor sensor;
  sensor.layout = MatrixLayout::full(40, 8, 3.4);
  SyntheticSlip slip(sensor, 2);
  SlipTracker tracker = trackerOf(SlipMethod::kRegister, sensor.layout);
  SyntheticContact contact;
  contact.shape = SlipShape::kFlatEllipse;
  contact.x = 3.5;
  int keys = 0;
  for (int i = 0; i <= 160; ++i) {
    contact.y = 6.0 + 0.15 * i;
    const SlipMotion& motion = tracker.update(viewOf(reading(slip, contact)));
    keys += motion.newKey ? 1 : 0;
  }
  EXPECT_NEAR(tracker.last().refDy, 24.0, 0.2);
  EXPECT_GT(keys, 5);
}

TEST(SlipTracker, SaturationIsCountedAndLowersConfidence) {
  SlipTracker tracker(SyntheticSensor{}.layout,
                      {.method = SlipMethod::kCentroid, .saturationCounts = 3500.0});
  MatrixValues values = MatrixValues::Zero(14, 6);
  values.block(5, 2, 3, 2).setConstant(1000.0F);
  EXPECT_EQ(tracker.update(viewOf(values)).saturated, 0);
  EXPECT_DOUBLE_EQ(tracker.last().confidence, 1.0);
  values(6, 2) = 3560.0F;
  EXPECT_EQ(tracker.update(viewOf(values)).saturated, 1);
  EXPECT_NEAR(tracker.last().confidence, 1.0 - 3560.0 / 8560.0, 1e-6);
  values.setZero();
  values.block(5, 0, 3, 1).setConstant(1000.0F);  // at the side: may go on outside
  EXPECT_EQ(tracker.update(viewOf(values)).confidence, 0.0);
}

TEST(SlipTracker, FullySaturatedOrTinyMatricesDoNotHurt) {
  for (const SlipMethod method : methods())
    for (const auto& [rows, columns] : {std::pair{14, 6}, {1, 1}, {1, 7}, {5, 1}, {2, 2}}) {
      SlipTracker tracker = trackerOf(method, MatrixLayout::full(rows, columns, 3.4));
      const MatrixValues values = MatrixValues::Constant(rows, columns, 4095.0F);
      for (int i = 0; i < 4; ++i) {
        const SlipMotion& motion = tracker.update(viewOf(values));
        EXPECT_TRUE(std::isfinite(motion.dx) && std::isfinite(motion.refDy));
        EXPECT_NEAR(motion.dx, 0.0, 0.02) << nameOf(method) << rows << "x" << columns;
        EXPECT_NEAR(motion.dy, 0.0, 0.02) << nameOf(method) << rows << "x" << columns;
      }
    }
}

TEST(SlipTracker, TakesNoMemoryPerFrame) {
  SyntheticSlip slip({}, 2);
  std::vector<MatrixValues> frames;
  for (int i = 0; i < 60; ++i) {
    SyntheticContact contact;
    contact.shape = SlipShape::kBar;
    contact.y = 4.0 + 0.1 * i;  // far enough for a new key
    frames.push_back(reading(slip, contact));
    if (i % 20 == 19) frames.push_back(MatrixValues::Zero(14, 6));
  }
  for (const SlipMethod method : methods()) {
    SlipTracker tracker = trackerOf(method);
    tracker.update(viewOf(frames[0]));
    testing::countAllocations();
    for (const MatrixValues& frame : frames) tracker.update(viewOf(frame));
    tracker.setReference();
    tracker.update(viewOf(frames[0]));
    EXPECT_EQ(testing::allocationsCounted(), 0) << nameOf(method);
  }
}

TEST(SlipTracker, RefusesWhatItCantDo) {
  SlipTrackerOptions options;
  options.method = SlipMethod::kContest;
  EXPECT_THROW(SlipTracker(MatrixLayout::full(2, 2, 3.4), options), std::invalid_argument);
  options = {};
  options.maxStepTaxels = 0;
  EXPECT_THROW(SlipTracker(MatrixLayout::full(2, 2, 3.4), options), std::invalid_argument);
  SlipTracker tracker = trackerOf(SlipMethod::kCentroid);
  const MatrixValues other = MatrixValues::Zero(13, 6);
  EXPECT_THROW(tracker.update(viewOf(other)), std::invalid_argument);
}

TEST(SensorSlipTracker, KnowsGapsByTheStamps) {
  const auto layout = std::make_shared<const SensorLayout>(
      std::vector{MatrixLayout::full(14, 6, 3.4), MatrixLayout::full(13, 6, 3.4)});
  SensorSlipTracker tracker(*layout);
  TactileFrame frame(layout);
  frame.matrix(1).block(4, 2, 3, 2).setConstant(900.0F);
  for (int i = 0; i < 5; ++i) {
    frame.hostUs = 1'000'000 + 33'000 * i;
    const auto& motions = tracker.update(frame);
    ASSERT_EQ(motions.size(), 2U);
    EXPECT_EQ(motions[0].active, 0);
    EXPECT_EQ(motions[1].valid, i > 0);
  }
  frame.hostUs += 147'000'000;
  EXPECT_TRUE(tracker.update(frame)[1].afterGap);
  EXPECT_FALSE(tracker.last()[1].valid);
  EXPECT_TRUE(tracker.last()[1].refValid);
  frame.hostUs += 33'000;
  EXPECT_TRUE(tracker.update(frame)[1].valid);
  tracker.setReference();
  EXPECT_TRUE(tracker.last()[1].refValid);
  tracker.reset();
  EXPECT_EQ(tracker.last()[1].active, 0);
  const TactileFrame other(
      std::make_shared<const SensorLayout>(std::vector{MatrixLayout::full(14, 6, 3.4)}));
  EXPECT_THROW(tracker.update(other), std::invalid_argument);
}

// Frame rates of 0.3 and 300 Hz give the same results, because no quantity is per second.
TEST(SensorSlipTracker, AnyRateGivesTheSameMotion) {
  const auto layout =
      std::make_shared<const SensorLayout>(std::vector{MatrixLayout::full(14, 6, 3.4)});
  SyntheticSlip slip({}, 3);
  std::vector<MatrixValues> readings;
  for (int i = 0; i < 10; ++i) {
    SyntheticContact contact;
    contact.y = 6.0 + 0.05 * i;
    readings.push_back(reading(slip, contact));
  }
  for (const std::int64_t intervalUs : {3'300, 33'000, 3'300'000}) {
    SensorSlipTracker tracker(*layout);
    double path = 0.0;
    TactileFrame frame(layout);
    for (const MatrixValues& values : readings) {
      frame.hostUs += intervalUs;
      frame.matrix(0) = values;
      path += tracker.update(frame)[0].dy;
    }
    EXPECT_NEAR(path, tracker.last()[0].refDy, 1e-9) << intervalUs;
    EXPECT_NEAR(path, 0.45, 0.03) << intervalUs;
  }
}

}  // namespace
}  // namespace palpate::slip_tracker_test

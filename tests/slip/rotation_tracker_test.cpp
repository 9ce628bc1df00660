#include "palpate/slip/rotation_tracker.h"

#include <algorithm>
#include <cmath>

#include "slip_scene.h"
#include "testing/testing.h"

namespace palpate::rotation_tracker_test {
namespace {

// Moments of an elongated contact at an angle, computed without a sensor model.
ContactMoments lying(double angleDeg, double along = 4.0, double across = 1.0) {
  const double angle = angleDeg * M_PI / 180.0;
  ContactMoments moments;
  moments.active = 20;
  moments.sum = 1.0;
  moments.mu20 = along * std::pow(std::cos(angle), 2) + across * std::pow(std::sin(angle), 2);
  moments.mu02 = along * std::pow(std::sin(angle), 2) + across * std::pow(std::cos(angle), 2);
  moments.mu11 = (along - across) * std::sin(angle) * std::cos(angle);
  return moments;
}

TEST(RotationTracker, CountsWholeTurnsBothWays) {
  RotationTracker tracker;
  for (int i = 0; i <= 100; ++i) {
    const SlipRotation& rotation = tracker.update(lying(30.0 + 9.0 * i), 0.5);
    EXPECT_TRUE(rotation.reliable);
    EXPECT_EQ(rotation.valid, i > 0);
    EXPECT_TRUE(rotation.refValid);
    EXPECT_NEAR(rotation.rotationDeg, i > 0 ? 9.0 : 0.0, 1e-9);
    EXPECT_NEAR(rotation.refRotationDeg, 9.0 * i, 1e-7);
  }
  for (int i = 99; i >= -50; --i)
    EXPECT_NEAR(tracker.update(lying(30.0 + 9.0 * i), 0.5).refRotationDeg, 9.0 * i, 1e-7);
}

// By turns of 60 degrees the axis could have turned by -120 as well: no number of turns is known
// until there is a new reference.
TEST(RotationTracker, AJumpOfTheAxisLosesTheCountOfTurns) {
  RotationTracker tracker;
  tracker.update(lying(10.0), 0.5);
  EXPECT_NEAR(tracker.update(lying(54.0), 0.5).refRotationDeg, 44.0, 1e-9);
  EXPECT_FALSE(tracker.update(lying(114.0), 0.5).refValid);
  SlipRotation rotation = tracker.update(lying(118.0), 0.5);
  EXPECT_TRUE(rotation.valid);
  EXPECT_NEAR(rotation.rotationDeg, 4.0, 1e-9);
  EXPECT_FALSE(rotation.refValid);
  EXPECT_EQ(rotation.refRotationDeg, 44.0) << "the last one that was known";
  tracker.setReference();
  rotation = tracker.update(lying(120.0), 0.5);
  EXPECT_TRUE(rotation.refValid);
  EXPECT_NEAR(rotation.refRotationDeg, 2.0, 1e-9);
}

TEST(RotationTracker, RoundContactsHaveNoDirection) {
  RotationTracker tracker;
  tracker.update(lying(10.0), 0.5);
  const SlipRotation round = tracker.update(lying(50.0, 1.1, 1.0), 0.95);
  EXPECT_FALSE(round.reliable);
  EXPECT_FALSE(round.valid);
  EXPECT_FALSE(round.refValid);
  // A round outline or a low eccentricity alone does not make the axis unreliable (rule of the
  // study).
  EXPECT_TRUE(tracker.update(lying(20.0, 1.1, 1.0), 0.8).reliable);
  EXPECT_TRUE(tracker.update(lying(20.0, 4.0, 1.0), 0.95).reliable);
}

TEST(RotationTracker, BehindAnInterruptionTheReferenceHoldsAndTheStepIsUnknown) {
  RotationTracker tracker;
  tracker.update(lying(10.0), 0.5);
  tracker.update({}, 0.0);  // contact lost
  SlipRotation rotation = tracker.update(lying(25.0), 0.5);
  EXPECT_FALSE(rotation.valid);
  EXPECT_TRUE(rotation.refValid);
  EXPECT_NEAR(rotation.refRotationDeg, 15.0, 1e-9);
  tracker.skip();
  rotation = tracker.update(lying(30.0), 0.5);
  EXPECT_FALSE(rotation.valid);
  rotation = tracker.update(lying(31.0), 0.5);
  EXPECT_TRUE(rotation.valid);
  EXPECT_NEAR(rotation.rotationDeg, 1.0, 1e-9);
}

TEST(RotationTracker, ReferenceIsTakenWhenItIsAskedFor) {
  RotationTracker tracker;
  tracker.update(lying(10.0), 0.5);
  tracker.update(lying(40.0), 0.5);
  EXPECT_TRUE(tracker.setReference());
  EXPECT_NEAR(tracker.update(lying(45.0), 0.5).refRotationDeg, 5.0, 1e-9);
  tracker.update(lying(0.0, 1.0, 1.0), 1.0);
  // The contact is round now: the next frame with a direction becomes the reference.
  EXPECT_FALSE(tracker.setReference());
  EXPECT_NEAR(tracker.update(lying(80.0), 0.5).refRotationDeg, 0.0, 1e-9);
  tracker.clearReference();
  EXPECT_FALSE(tracker.update(lying(81.0), 0.5).refValid);
  tracker.reset();
  EXPECT_TRUE(tracker.update(lying(81.0), 0.5).refValid);
}

TEST(RotationTracker, TooFewTaxelsTellNothing) {
  RotationTracker tracker;
  ContactMoments two = lying(30.0);
  two.active = 2;
  EXPECT_FALSE(tracker.update(two, 0.0).reliable);
  RotationOptions options;
  options.minEccentricity = 1.5;
  EXPECT_THROW(RotationTracker{options}, std::invalid_argument);
}

// A disc that slides along the lower side of the matrix, partly outside, into the corner: the
// axis of the visible part turns from 0 to about 90 degrees, the disc doesn't turn.
TEST(RotationTracker, AContactCutByASideDoesNotTurnWithItsVisiblePart) {
  SyntheticSensor sensor;
  sensor.thresholdCounts = 0.0;
  RotationTracker tracker;
  double visibleDeg = 0.0;
  int unknown = 0;
  for (int i = 0; i <= 30; ++i) {
    const MatrixValues values = testing::idealReading({.x = 2.5 + 0.1 * i, .y = 12.0}, sensor);
    const ContactMoments moments = contactMoments(testing::viewOf(values));
    const double axisDeg = principalAxis(moments).orientationDeg;
    visibleDeg = std::max(visibleDeg, std::min(axisDeg, 180.0 - axisDeg));
    const bool determined = axisIsDetermined(testing::viewOf(values), moments);
    const SlipRotation& rotation = tracker.update(moments, 0.7, determined);
    unknown += rotation.reliable ? 0 : 1;
    const double readDeg = rotation.refValid ? rotation.refRotationDeg : 0.0;
    EXPECT_NEAR(readDeg, 0.0, kMaxCutAxisDeg) << i;
    EXPECT_TRUE(determined || !(rotation.valid || rotation.refValid)) << i;
  }
  EXPECT_GT(visibleDeg, 80.0);
  EXPECT_GT(unknown, 15);
}

// A bar at 30 degrees to the columns that leaves the matrix lengthwise shows its direction: 120
// degrees from +x. Inside the matrix nothing is cut.
TEST(RotationTracker, ABarThatLeavesTheMatrixLengthwiseKeepsItsDirection) {
  SyntheticSensor sensor;
  for (const double y : {6.5, 11.0, 11.5}) {
    const MatrixValues values =
        testing::idealReading({.shape = SlipShape::kBar, .y = y, .angleDeg = 30.0}, sensor);
    const ContactMoments moments = contactMoments(testing::viewOf(values));
    EXPECT_TRUE(axisIsDetermined(testing::viewOf(values), moments)) << y;
    EXPECT_NEAR(principalAxis(moments).orientationDeg, 120.0, 12.0) << y;
  }
  EXPECT_TRUE(axisIsDetermined(testing::viewOf(MatrixValues::Zero(14, 6)), {}));
}

// The last two rows of a contact that moves out over the side look like a bar along the side,
// whatever the contact was. The same bar inside of the matrix has an axis.
TEST(RotationTracker, AStripAlongASideMayBeTheEndOfAnything) {
  for (const Eigen::Index top : {6, 12}) {
    MatrixValues values = MatrixValues::Zero(14, 8);
    values.block(top, 1, 2, 6).setConstant(500.0F);
    const ContactMoments moments = contactMoments(testing::viewOf(values));
    EXPECT_NEAR(std::remainder(principalAxis(moments).orientationDeg, 180.0), 0.0, 1e-6);
    EXPECT_EQ(axisIsDetermined(testing::viewOf(values), moments), top == 6);
  }
}

}  // namespace
}  // namespace palpate::rotation_tracker_test

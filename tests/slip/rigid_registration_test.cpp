#include "palpate/slip/rigid_registration.h"

#include <cmath>

#include "slip_scene.h"
#include "testing/testing.h"

namespace palpate::rigid_registration_test {
namespace {

using testing::reading;
using testing::viewOf;

constexpr double kDeg = M_PI / 180.0;

// Motion of the key's centroid when the contact moves and rotates about its own centre.
RigidMotion truthOf(const KeyFrame& key, const SyntheticContact& from, const SyntheticContact& to) {
  const double kx = key.centerX() - from.x;
  const double ky = key.centerY() - from.y;
  const double turn = (to.angleDeg - from.angleDeg) * kDeg;
  return {to.x - from.x + std::cos(turn) * kx - std::sin(turn) * ky - kx,
          to.y - from.y + std::sin(turn) * kx + std::cos(turn) * ky - ky,
          to.angleDeg - from.angleDeg,
          to.peakCounts / from.peakCounts};
}

TEST(RigidRegistration, FindsMotionTurnAndGainOfEveryShape) {
  SyntheticSensor sensor;
  SyntheticSlip slip(sensor, 3);
  for (const SlipShape shape : slipShapes()) {
    SyntheticContact from;
    from.shape = shape;
    from.x = 2.4;
    RigidRegistration registration(sensor.layout);
    ASSERT_TRUE(registration.setKey(viewOf(reading(slip, from))));
    SyntheticContact to = from;
    to.x += 0.3;
    to.y -= 0.4;
    to.angleDeg = 4.0;
    to.peakCounts *= 1.1;
    const RegistrationResult result = registration.estimate(viewOf(reading(slip, to)));
    const RigidMotion truth = truthOf(registration.key(), from, to);
    EXPECT_TRUE(result.converged) << nameOf(shape);
    EXPECT_NEAR(result.motion.dx, truth.dx, 0.04) << nameOf(shape);
    EXPECT_NEAR(result.motion.dy, truth.dy, 0.04) << nameOf(shape);
    EXPECT_NEAR(result.motion.gain, truth.gain, 0.04) << nameOf(shape);
    if (hasOrientation(shape))
      EXPECT_NEAR(result.motion.angleDeg, truth.angleDeg, 1.0) << nameOf(shape);
    else
      EXPECT_EQ(result.motion.angleDeg, 0.0) << nameOf(shape);
    EXPECT_GT(result.overlap, 0.9);
  }
}

TEST(RigidRegistration, FollowsAContactThatLeavesByTheSide) {
  SyntheticSensor sensor;
  SyntheticSlip slip(sensor, 5);
  for (const SlipShape shape : slipShapes()) {
    SyntheticContact contact;
    contact.shape = shape;
    // Its centroid is 1.5 taxels from the centre of the last column.
    contact.x = 3.5;
    RigidRegistration registration(sensor.layout);
    ASSERT_TRUE(registration.setKey(viewOf(reading(slip, contact))));
    RigidMotion motion;
    for (int i = 1; i <= 10; ++i) {
      contact.x = 3.5 + 0.15 * i;
      motion = registration.estimate(viewOf(reading(slip, contact)), motion).motion;
    }
    EXPECT_NEAR(motion.dx, 1.5, 0.12) << nameOf(shape);
  }
}

TEST(RigidRegistration, LeavesOutMaskedAndSaturatedTaxels) {
  SyntheticSensor sensor;
  for (const int place : {6 * 6 + 2, 7 * 6 + 3}) sensor.layout.dynamicMask[place] = 0;
  sensor.saturationCounts = 1200.0;
  SyntheticSlip slip(sensor, 5);
  SyntheticContact contact;
  contact.shape = SlipShape::kFlatEllipse;
  RegistrationOptions options;
  options.saturationCounts = 1200.0;
  RigidRegistration registration(sensor.layout, options);
  ASSERT_TRUE(registration.setKey(viewOf(reading(slip, contact))));
  contact.x += 0.25;
  contact.y += 0.45;
  const RegistrationResult result = registration.estimate(viewOf(reading(slip, contact)));
  EXPECT_NEAR(result.motion.dx, 0.25, 0.06);
  EXPECT_NEAR(result.motion.dy, 0.45, 0.06);
}

TEST(RigidRegistration, WithoutAKeyOrWithoutContactThereIsNoMotion) {
  SyntheticSensor sensor;
  SyntheticSlip slip(sensor);
  const MatrixValues nothing = MatrixValues::Zero(14, 6);
  RigidRegistration registration(sensor.layout);
  EXPECT_FALSE(registration.hasKey());
  const MatrixValues touched = reading(slip, {});
  EXPECT_FALSE(registration.estimate(viewOf(touched)).converged);
  EXPECT_FALSE(registration.setKey(viewOf(nothing)));
  MatrixValues one = nothing;
  one(3, 3) = 900.0F;
  EXPECT_FALSE(registration.setKey(viewOf(one)));
  ASSERT_TRUE(registration.setKey(viewOf(touched)));
  const RegistrationResult result = registration.estimate(viewOf(nothing), {0.5, 0.25, 0.0, 1.0});
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.motion.dx, 0.5);  // the start
  EXPECT_EQ(result.taxels, 0);
}

TEST(RigidRegistration, RefusesWhatItCantWorkWith) {
  RigidRegistration registration(MatrixLayout::full(14, 6, 3.4));
  const MatrixValues other = MatrixValues::Constant(13, 6, 500.0F);
  EXPECT_THROW(registration.setKey(viewOf(other)), std::invalid_argument);
  EXPECT_THROW(registration.estimate(viewOf(other)), std::invalid_argument);
  RegistrationOptions options;
  options.noiseCounts = 0.0;
  EXPECT_THROW(RigidRegistration(MatrixLayout::full(2, 2, 1.0), options), std::invalid_argument);
}

TEST(RigidRegistration, TinyMatricesDoNotHurt) {
  for (const auto& [rows, columns] : {std::pair{1, 1}, {1, 5}, {2, 2}, {7, 1}}) {
    const MatrixLayout layout = MatrixLayout::full(rows, columns, 3.4);
    RigidRegistration registration(layout);
    const MatrixValues values = MatrixValues::Constant(rows, columns, 800.0F);
    registration.setKey(viewOf(values));
    const RegistrationResult result = registration.estimate(viewOf(values));
    EXPECT_NEAR(result.motion.dx, 0.0, 1e-6);
    EXPECT_NEAR(result.motion.dy, 0.0, 1e-6);
  }
}

}  // namespace
}  // namespace palpate::rigid_registration_test

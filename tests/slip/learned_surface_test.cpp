#include "palpate/slip/learned_surface.h"

#include <cmath>

#include "slip_scene.h"
#include "testing/testing.h"

namespace palpate::learned_surface_test {
namespace {

using testing::idealReading;
using testing::reading;
using testing::viewOf;

TEST(LearnedSurface, BeginsAsTheKeyFrameItIsGiven) {
  SyntheticSlip slip({}, 3);
  const MatrixValues values = reading(slip, {});
  LearnedSurface surface(slip.sensor().layout);
  KeyFrame key(slip.sensor().layout);
  ASSERT_TRUE(surface.set(viewOf(values), 5.0));
  ASSERT_TRUE(key.set(viewOf(values)));
  for (float y = 0.0F; y <= 13.0F; y += 0.37F)
    for (float x = 0.0F; x <= 5.0F; x += 0.29F) {
      const KeyFrame::Sample expected = key.at(x, y);
      const LearnedSurface::Sample sample = surface.at(x, y);
      // The finer spline is the same function except near the rim, where values outside were
      // limited.
      if (x < 1.0F || x > 4.0F || y < 1.0F || y > 12.0F) continue;
      EXPECT_NEAR(sample.value, expected.value, 0.1F) << x << " " << y;
      EXPECT_NEAR(sample.alongX, expected.alongX, 0.5F) << x << " " << y;
      EXPECT_NEAR(sample.alongY, expected.alongY, 0.5F) << x << " " << y;
    }
}

// The values between taxels are learnt when the contact moves. They are compared with frames that
// were not used for learning.
TEST(LearnedSurface, GetsBetterBetweenTheTaxels) {
  SyntheticSensor sensor;
  SyntheticSlip slip(sensor, 3);
  SyntheticContact start;
  start.shape = SlipShape::kFlatEllipse;
  const auto offOf = [&](const LearnedSurface& surface) {
    double squares = 0.0;
    int count = 0;
    SyntheticContact moved = start;
    moved.x += 0.45;
    moved.y += 0.5;
    const MatrixValues ideal = idealReading(moved, sensor);
    for (int y = 1; y < 13; ++y)
      for (int x = 1; x < 5; ++x) {
        if (ideal(y, x) < 200.0F) continue;
        const float value =
            surface.at(static_cast<float>(x) - 0.45F, static_cast<float>(y) - 0.5F).value;
        squares += std::pow(static_cast<double>(value - ideal(y, x)), 2);
        ++count;
      }
    return std::sqrt(squares / count);
  };
  LearnedSurface surface(sensor.layout);
  ASSERT_TRUE(surface.set(viewOf(reading(slip, start)), 5.0));
  const double before = offOf(surface);
  const RegistrationOptions options{.noiseCounts = 5.0, .relativeError = 0.001};
  for (int i = 0; i < 60; ++i) {
    SyntheticContact moved = start;
    RegistrationResult known;
    known.motion.dx = 0.5 * std::sin(0.7 * i);
    known.motion.dy = 0.5 * std::sin(1.1 * i);
    moved.x += known.motion.dx;
    moved.y += known.motion.dy;
    surface.learn(viewOf(reading(slip, moved)), known, options);
  }
  EXPECT_GT(before, 20.0);
  EXPECT_LT(offOf(surface), 0.4 * before);
}

TEST(LearnedSurface, KnowsTheOutsideLittleUntilItCameIn) {
  SyntheticSlip slip({}, 3);
  SyntheticContact contact;
  contact.x = 4.6;  // cut by the right side
  LearnedSurface surface(slip.sensor().layout);
  ASSERT_TRUE(surface.set(viewOf(reading(slip, contact)), 5.0));
  const float before = surface.at(6.0F, 6.5F).variance;
  EXPECT_GT(before, 100.0F * surface.at(4.0F, 6.0F).variance);
  const RegistrationOptions options{.noiseCounts = 5.0, .relativeError = 0.001};
  for (int i = 1; i <= 12; ++i) {
    contact.x = 4.6 - 0.1 * i;
    RegistrationResult known;
    known.motion.dx = -0.1 * i;
    surface.learn(viewOf(reading(slip, contact)), known, options);
  }
  EXPECT_LT(surface.at(6.0F, 6.5F).variance, 0.1F * before);
  contact.x = 3.6;
  const MatrixValues ideal = idealReading(contact, slip.sensor());
  EXPECT_NEAR(surface.at(6.0F, 6.0F).value, ideal(6, 5), 0.1F * ideal(6, 5) + 20.0F);
}

TEST(LearnedSurface, RegistersLikeAKeyFrame) {
  SyntheticSlip slip({}, 8);
  for (const SlipShape shape : slipShapes()) {
    SyntheticContact contact;
    contact.shape = shape;
    LearnedSurface surface(slip.sensor().layout);
    ASSERT_TRUE(surface.set(viewOf(reading(slip, contact)), 5.0));
    contact.x += 0.2;
    contact.y -= 0.3;
    const RegistrationResult result =
        registerFrame(surface, viewOf(reading(slip, contact)), {}, RegistrationOptions{});
    EXPECT_TRUE(result.converged) << nameOf(shape);
    EXPECT_NEAR(result.motion.dx, 0.2, 0.08) << nameOf(shape);
    EXPECT_NEAR(result.motion.dy, -0.3, 0.08) << nameOf(shape);
  }
}

TEST(LearnedSurface, NothingIsNoKey) {
  LearnedSurface surface(MatrixLayout::full(14, 6, 3.4));
  const MatrixValues nothing = MatrixValues::Zero(14, 6);
  EXPECT_FALSE(surface.set(viewOf(nothing), 5.0));
  EXPECT_TRUE(surface.empty());
  EXPECT_FALSE(registerFrame(surface, viewOf(nothing), {}, {}).converged);
  surface.learn(viewOf(nothing), {}, {});
  LearnedSurfaceOptions options;
  options.processNoiseRatio = -1.0;
  EXPECT_THROW(LearnedSurface(MatrixLayout::full(2, 2, 3.4), options), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::learned_surface_test

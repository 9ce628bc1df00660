#include "palpate/laboratory/synthetic_slip.h"

#include <cmath>

#include "palpate/slip/contact_moments.h"

#include "slip/slip_scene.h"
#include "testing/testing.h"

namespace palpate::synthetic_slip_test {
namespace {

using testing::idealReading;
using testing::reading;
using testing::viewOf;

TEST(SyntheticSlip, GaussianIsTheClosedForm) {
  SyntheticContact contact;
  contact.shape = SlipShape::kGaussian;
  contact.x = 2.3;
  contact.y = 6.1;
  const MatrixValues values = idealReading(contact, {});
  const auto mean = [](double from, double center) {  // over a taxel, sd 1.5
    const double scale = 1.5 * std::sqrt(2.0);
    return 1.5 * std::sqrt(M_PI / 2.0) *
           (std::erf((from + 0.5 - center) / scale) - std::erf((from - 0.5 - center) / scale));
  };
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 6; ++x)
      EXPECT_NEAR(static_cast<double>(values(y, x)), 1500.0 * mean(x, 2.3) * mean(y, 6.1), 0.01);
}

TEST(SyntheticSlip, EveryShapeLiesAtItsCenterAndMovesWithIt) {
  SyntheticSensor wide;
  wide.layout = MatrixLayout::full(30, 30, 3.4);
  for (const SlipShape shape : slipShapes()) {
    SyntheticContact contact;
    contact.shape = shape;
    contact.x = 14.0;
    contact.y = 15.0;
    contact.angleDeg = 30.0;
    const ContactMoments before = contactMoments(viewOf(idealReading(contact, wide)));
    contact.x += 0.37;
    contact.y -= 1.21;
    const ContactMoments after = contactMoments(viewOf(idealReading(contact, wide)));
    // The edge is sampled, so that the centroid is correct only to a few hundredths.
    EXPECT_NEAR(after.x - before.x, 0.37, 0.03) << nameOf(shape);
    EXPECT_NEAR(after.y - before.y, -1.21, 0.03) << nameOf(shape);
    EXPECT_NEAR(after.sum / before.sum, 1.0, 0.01) << nameOf(shape);
    if (shape != SlipShape::kTwoBlobs) {
      EXPECT_NEAR(before.x, 14.0, 0.03) << nameOf(shape);
      EXPECT_NEAR(before.y, 15.0, 0.03) << nameOf(shape);
    }
  }
}

TEST(SyntheticSlip, TurnsFromXTowardsY) {
  SyntheticSensor wide;
  wide.layout = MatrixLayout::full(30, 30, 3.4);
  for (const SlipShape shape : slipShapes()) {
    SyntheticContact contact;
    contact.shape = shape;
    contact.x = 14.0;
    contact.y = 15.0;
    contact.angleDeg = 20.0;
    const ContactMoments moments = contactMoments(viewOf(idealReading(contact, wide)));
    if (!hasOrientation(shape)) continue;
    const double angle =
        0.5 * std::atan2(2.0 * moments.mu11, moments.mu20 - moments.mu02) * 180.0 / M_PI;
    // The shape is long along y at 0 deg, so that its axis is at 90 + 20 deg, which equals -70 deg.
    EXPECT_NEAR(angle, -70.0, 1.0) << nameOf(shape);
  }
}

TEST(SyntheticSlip, TiltMovesLoadNotTheContact) {
  SyntheticContact contact;
  contact.tiltY = 0.4;
  const MatrixValues tilted = idealReading(contact, {});
  contact.tiltY = 0.0;
  const MatrixValues level = idealReading(contact, {});
  EXPECT_GT(contactMoments(viewOf(tilted)).y, contactMoments(viewOf(level)).y + 0.1);
  // In the centre row the mean gain is 1; far below it approaches 1.4 (tanh).
  EXPECT_NEAR(static_cast<double>(tilted(8, 2) / level(8, 2)), 1.0 + 0.4 * std::tanh(0.75), 0.02);
  EXPECT_NEAR(static_cast<double>(tilted(5, 2) / level(5, 2)), 1.0 - 0.4 * std::tanh(0.75), 0.02);
}

TEST(SyntheticSlip, ReadsAsASensorDoes) {
  SyntheticSensor sensor;
  sensor.noiseSd = 20.0;
  sensor.saturationCounts = 3560.0;
  sensor.layout.dynamicMask[6 * 6 + 2] = 0;
  SyntheticContact contact;
  contact.peakCounts = 3555.0;
  SyntheticSlip slip(sensor, 7);
  const MatrixValues values = reading(slip, contact);
  EXPECT_EQ(values(6, 2), 0.0F);       // masked
  EXPECT_EQ(values(0, 0), 0.0F);       // below the threshold
  EXPECT_EQ(values.maxCoeff(), 3560);  // saturated
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    EXPECT_EQ(values.data()[i], std::round(values.data()[i]));
    EXPECT_TRUE(values.data()[i] == 0.0F || values.data()[i] >= 150.0F);
  }
  SyntheticSlip again(sensor, 7);
  EXPECT_EQ(reading(again, contact), values);
  SyntheticSlip other(sensor, 8);
  EXPECT_NE(reading(other, contact), values);
}

TEST(SyntheticSlip, NoiseHasItsSd) {
  SyntheticSensor sensor;
  sensor.noiseSd = 12.0;
  SyntheticSlip slip(sensor);
  SyntheticContact contact;
  const double ideal = static_cast<double>(idealReading(contact, sensor)(6, 2));
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kReadings = 4000;
  for (int i = 0; i < kReadings; ++i) {
    const double off = static_cast<double>(reading(slip, contact)(6, 2)) - ideal;
    sum += off;
    squares += off * off;
  }
  EXPECT_NEAR(sum / kReadings, 0.0, 0.8);  // 4 sd of the mean
  EXPECT_NEAR(std::sqrt(squares / kReadings), 12.0, 0.6);
}

TEST(SyntheticSlip, RefusesWhatCantBe) {
  SyntheticSensor sensor;
  sensor.noiseSd = -1.0;
  EXPECT_THROW(SyntheticSlip{sensor}, std::invalid_argument);
  sensor = {};
  sensor.saturationCounts = 100.0;
  EXPECT_THROW(SyntheticSlip{sensor}, std::invalid_argument);
  sensor = {};
  sensor.coverTaxels = 0.0;
  EXPECT_THROW(SyntheticSlip{sensor}, std::invalid_argument);
  MatrixValues small(3, 3);
  EXPECT_THROW(idealCounts({}, {}, MatrixMap(small.data(), 3, 3)), std::invalid_argument);
  EXPECT_EQ(slipShapeNamed("two-blobs"), SlipShape::kTwoBlobs);
  EXPECT_EQ(slipShapeNamed("square"), std::nullopt);
}

}  // namespace
}  // namespace palpate::synthetic_slip_test

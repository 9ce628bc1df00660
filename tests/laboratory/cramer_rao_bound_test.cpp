#include "palpate/laboratory/cramer_rao_bound.h"

#include <cmath>

#include "testing/testing.h"

namespace palpate::cramer_rao_bound_test {
namespace {

TEST(CramerRaoBound, OfAGaussianIsTheClosedForm) {
  // Sum over taxels of (dF/dx)^2 = peak^2 pi / 2 for a sampled Gaussian wide enough; the mean over
  // a taxel widens it to s^2 + 1/12 and lowers the peak by s^2/(s^2 + 1/12), which leaves
  // (s^2/(s^2+1/12))^2 of it. Two frames: factor sqrt 2.
  SyntheticSensor sensor;
  sensor.layout = MatrixLayout::full(30, 30, 3.4);
  sensor.thresholdCounts = 0.0;
  sensor.saturationCounts = 4095.0;
  SyntheticContact contact;
  contact.shape = SlipShape::kGaussian;
  contact.x = 14.6;
  contact.y = 15.2;
  const double s2 = 1.5 * 1.5;
  const double kept = s2 / (s2 + 1.0 / 12.0);
  const double noise = std::sqrt(25.0 + 1.0 / 12.0);
  const double expected = std::sqrt(2.0) * noise / (1500.0 * kept * std::sqrt(M_PI / 2.0));
  // At a threshold of 0 half of the readings of taxels without load are cut off, but these have no
  // slope.
  const CramerRaoBound bound = cramerRaoBound(contact, sensor);
  EXPECT_NEAR(bound.x, expected, 0.02 * expected);
  EXPECT_NEAR(bound.y, expected, 0.02 * expected);
  EXPECT_TRUE(std::isinf(bound.angleDeg));
}

TEST(CramerRaoBound, GrowsWithNoiseAndWithTilt) {
  for (const SlipShape shape : slipShapes()) {
    SyntheticContact contact;
    contact.shape = shape;
    contact.y = 6.7;
    SyntheticSensor quiet;
    SyntheticSensor loud;
    loud.noiseSd = 20.0;
    const CramerRaoBound a = cramerRaoBound(contact, quiet);
    const CramerRaoBound b = cramerRaoBound(contact, loud);
    EXPECT_NEAR(b.x / a.x, 4.0, 0.15) << nameOf(shape);
    EXPECT_NEAR(b.y / a.y, 4.0, 0.15) << nameOf(shape);
    const CramerRaoBound tilted = cramerRaoBound(contact, quiet, {true, true});
    EXPECT_GT(tilted.x, 1.2 * a.x) << nameOf(shape);
    EXPECT_EQ(std::isfinite(a.angleDeg), hasOrientation(shape));
  }
}

TEST(CramerRaoBound, IsInfiniteWhereNothingIsFelt) {
  SyntheticContact contact;
  contact.x = -20.0;
  EXPECT_TRUE(std::isinf(cramerRaoBound(contact, {}).x));
}

// Expectation of the squared score of a censored normal value, by integration.
TEST(CramerRaoBound, CensoredInformationIsTheIntegral) {
  for (const double z : {-2.0, -0.5, 0.0, 0.7, 2.5}) {
    double information = 0.0;
    const double step = 1e-4;
    for (double u = -z; u < 9.0; u += step) {  // (reading - mean)/sd above the threshold
      const double at = u + 0.5 * step;
      information += step * at * at * std::exp(-0.5 * at * at) / std::sqrt(2.0 * M_PI);
    }
    const double below = 0.5 * std::erfc(z / std::sqrt(2.0));
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * M_PI);
    information += density * density / below;  // of the fact that it is below
    EXPECT_NEAR(censoredInformation(z), information, 1e-3) << z;
  }
  EXPECT_NEAR(censoredInformation(20.0), 1.0, 1e-12);
  EXPECT_NEAR(censoredInformation(-20.0), 0.0, 1e-12);
}

}  // namespace
}  // namespace palpate::cramer_rao_bound_test

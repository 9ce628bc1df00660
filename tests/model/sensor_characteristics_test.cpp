#include "palpate/model/sensor_characteristics.h"

#include <gtest/gtest.h>

#include "palpate/model/hand_description.h"

namespace palpate {
namespace {

TEST(SensorCharacteristics, OneOfEachMatrixWithItsPowerUpSettings) {
  ASSERT_EQ(sdh2Sensor().matrices.size(), sdh2().layout->numMatrices());
  for (std::size_t m = 0; m < 6; ++m) {
    EXPECT_EQ(sdh2Sensor().matrices[m].thresholdCounts, m % 2 == 0 ? 150 : 300);
    EXPECT_EQ(sdh2Sensor().matrices[m].sensitivity, 0.5);
    for (const std::size_t place : sdh2Sensor().matrices[m].warmPlaces)
      EXPECT_LT(place, sdh2().layout->matrix(m).numPlaces());
  }
}

// 700 g on 1.1025 cm^2 are 62.286 kPa and 8 counts for 0.8 kPa more; slope of the plane at 35 deg C.
TEST(SensorCharacteristics, GainIsTheSlopeOfTheMeasuredPlane) {
  const double degC = 35.0;
  const double(&c)[4] = sdh2Sensor().pressure;
  const auto pressureAt = [&](double counts) {
    return c[0] + c[1] * degC + c[2] * counts + c[3] * counts * degC;
  };
  EXPECT_NEAR(
      sdh2Sensor().gainCountsPerKpa(degC), 100.0 / (pressureAt(600.0) - pressureAt(500.0)), 1e-9);
}

}  // namespace
}  // namespace palpate

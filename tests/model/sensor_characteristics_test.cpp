#include "palpate/model/sensor_characteristics.h"

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

namespace palpate::sensor_characteristics_test {
namespace {

TEST(SensorCharacteristics, OneOfEachMatrixWithItsPowerUpSettings) {
  ASSERT_EQ(sdh2Sensor().matrices.size(), sdh2().layout->numMatrices());
  for (std::size_t m = 0; m < 6; ++m) {
    EXPECT_EQ(sdh2Sensor().matrices[m].thresholdCounts, m % 2 == 0 ? 150 : 300);
    EXPECT_EQ(sdh2Sensor().matrices[m].sensitivity, 0.5);
    for (const OffsetTaxel& taxel : sdh2Sensor().matrices[m].raised) {
      EXPECT_LT(taxel.place, sdh2().layout->matrix(m).numCells());
      EXPECT_EQ(taxel.place % 6, 0u) << "the edge";
    }
    EXPECT_EQ(sdh2Sensor().matrices[m].raised.size(), m % 2 == 0 ? 7u : 0u);
  }
}

// The study's plane, evaluated for two K: their distance is the slope; the pressure at K = 0 the
// dead zone.
TEST(SensorCharacteristics, GainAndDeadZoneAreThoseOfTheMeasuredPlane) {
  const SensorCharacteristics& sensor = sdh2Sensor();
  for (const double degC : {30.0, 40.0, 48.0}) {
    const auto pressureAt = [&](double k) {
      return 31.8973801 - 0.6249430 * degC + 0.0977683 * k - 0.0000386 * k * degC;
    };
    EXPECT_NEAR(sensor.gainCountsPerKpa(degC) / sensor.countsPerMean,
                100.0 / (pressureAt(600.0) - pressureAt(500.0)),
                1e-9);
    EXPECT_NEAR(sensor.deadZoneKpa(degC) + sensor.thresholdKpa, pressureAt(0.0), 1e-9);
  }
  EXPECT_GT(sensor.deadZoneKpa(60.0), 0.0) << "the plane says less than nothing there";
}

TEST(SensorCharacteristics, ATaxelAnswersSmoothlyFromZeroToTheStraightLine) {
  const SensorCharacteristics& sensor = sdh2Sensor();
  constexpr double kDegC = 34.0;
  const double gain = sensor.gainCountsPerKpa(kDegC), dead = sensor.deadZoneKpa(kDegC);
  EXPECT_EQ(sensor.countsAbove(0.0, kDegC), 0.0);
  EXPECT_EQ(sensor.countsAbove(-1.0, kDegC), 0.0);
  // P^2 / (2 P0) at first, P - P0 far above.
  EXPECT_NEAR(sensor.countsAbove(0.01, kDegC), gain * 0.0001 / (2.0 * dead), 1e-6);
  EXPECT_NEAR(sensor.countsAbove(300.0, kDegC), gain * (300.0 - dead), 1e-6);
  double before = 0.0;
  for (double kpa = 0.1; kpa < 100.0; kpa += 0.1) {
    const double now = sensor.countsAbove(kpa, kDegC);
    EXPECT_GT(now, before);
    EXPECT_LE(now - before, gain * 0.1 + 1e-9);
    before = now;
  }
}

}  // namespace
}  // namespace palpate::sensor_characteristics_test

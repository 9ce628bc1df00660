#include "palpate/emulator/assumed_characteristics.h"

#include <gtest/gtest.h>

#include "device/stream_hands.h"

namespace palpate::testing::assumed_characteristics_test {
namespace {

TEST(AssumedCharacteristics, FullScaleIsReachedAtTheStatedPressure) {
  HandDescription hand = padHand({{2, 3}, {4, 4}});
  hand.maximumCounts = 1000.0F;
  const SensorCharacteristics sensor = assumedCharacteristics(hand);
  ASSERT_EQ(sensor.matrices.size(), 2u);
  EXPECT_EQ(sensor.matrices[0].noiseIntercept, 5.0);
  EXPECT_EQ(sensor.matrices[1].taxelSd, 1.0);
  // The dead zone takes 0.05 kPa of it.
  EXPECT_NEAR(sensor.countsAbove(kAssumedFullScaleKpa, 30.0), 1000.0, 0.3);
  EXPECT_NEAR(sensor.countsAbove(100.0, 30.0), 500.0, 0.3);
}

TEST(AssumedCharacteristics, KilopascalsAreThePressure) {
  HandDescription hand = padHand({{2, 3}});
  hand.maximumCounts = 600.0F;
  hand.unit = "kPa";
  EXPECT_NEAR(assumedCharacteristics(hand).countsAbove(300.0, 20.0), 300.0, 0.06);
}

}  // namespace
}  // namespace palpate::testing::assumed_characteristics_test

#include "palpate/calibration/noise_threshold.h"

#include <limits>
#include <stdexcept>

#include "palpate/device/sdh2.h"

#include "testing/testing.h"

namespace palpate::noise_threshold_test {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Two matrices: 30 + 0.5 T, rmse 1, measured at 25..55 deg C; sensors 1 and 2.
NoiseFloor floorOfTwo() {
  NoiseFloor floor;
  for (std::size_t m = 0; m < 2; ++m) {
    NoiseLine line;
    line.matrix = m;
    line.slope = 0.5;
    line.intercept = 30.0 + 10.0 * static_cast<double>(m);
    line.rmse = 1.0;
    line.minDegC = 25.0;
    line.maxDegC = 55.0;
    line.valid = true;
    floor.lines.push_back(line);
  }
  return floor;
}

NoiseThresholds twoMatrices(NoiseThresholdOptions options = {}) {
  return {floorOfTwo(), {1, 2}, {0.5, {150, 300}}, 30.0, options};
}

TEST(NoiseThreshold, IsTheLinePlusThreeRmseRoundedUp) {
  // 30 + .5 * 40 + 3 = 53; at 40.5 it is 53.25
  EXPECT_EQ(noiseThreshold(floorOfTwo().lines[0], 40.0), 53);
  EXPECT_EQ(noiseThreshold(floorOfTwo().lines[0], 40.5), 54);
  EXPECT_EQ(noiseThreshold(floorOfTwo().lines[0], 40.0, {.minCounts = 60}), 60);
  EXPECT_EQ(noiseThreshold(floorOfTwo().lines[0], 40.0, {.maxCounts = 50}), 50);
}

TEST(NoiseThreshold, EveryMatrixOfTheSdh2HasItsSensor) {
  EXPECT_EQ(nearestSensors(sdh2()), (std::vector<std::optional<std::size_t>>{1, 2, 3, 4, 5, 6}));
}

TEST(NoiseThreshold, FollowsTheTemperatureWithHysteresis) {
  NoiseThresholds thresholds = twoMatrices();
  const auto first = thresholds.update(0.0, std::vector{0.0, 40.0, 30.0}, 30.0);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->sensitivity, 1.0);
  EXPECT_EQ(first->counts, (std::vector{53, 58}));
  EXPECT_FALSE(thresholds.update(20.0, std::vector{0.0, 44.0, 30.0}, 30.0)) << "2 counts";
  const auto warmer = thresholds.update(30.0, std::vector{0.0, 46.0, 30.0}, 30.0);
  ASSERT_TRUE(warmer);
  EXPECT_EQ(warmer->counts, (std::vector{56, 58}));
  EXPECT_FALSE(thresholds.update(60.0, std::vector{0.0, 40.0, 30.0}, 30.0)) << "lower by 3 only";
  EXPECT_TRUE(thresholds.update(70.0, std::vector{0.0, 33.0, 30.0}, 30.0));
}

TEST(NoiseThreshold, WaitsBetweenTwoSettings) {
  NoiseThresholds thresholds = twoMatrices();
  ASSERT_TRUE(thresholds.update(0.0, std::vector{0.0, 30.0, 30.0}, 30.0));
  EXPECT_FALSE(thresholds.update(9.9, std::vector{0.0, 50.0, 30.0}, 30.0));
  EXPECT_TRUE(thresholds.update(10.0, std::vector{0.0, 50.0, 30.0}, 30.0));
}

TEST(NoiseThreshold, RisesWhileTheRateIsCollapsedAndComesDownInCalm) {
  NoiseThresholds thresholds = twoMatrices();
  const std::vector<double> degC = {0.0, 40.0, 30.0};
  thresholds.update(0.0, degC, 30.0);
  EXPECT_FALSE(thresholds.update(1.0, degC, 9.0)) << "a single slow look is none";
  EXPECT_FALSE(thresholds.update(1.5, degC, 9.0));
  const auto raised = thresholds.update(2.0, degC, 9.0);
  ASSERT_TRUE(raised) << "it doesn't wait for the interval of settings";
  EXPECT_EQ(raised->counts, (std::vector{63, 68}));
  EXPECT_TRUE(thresholds.status().guarding);
  EXPECT_TRUE(thresholds.update(3.0, degC, 9.0));
  EXPECT_EQ(thresholds.status().guardCounts, 20);
  EXPECT_FALSE(thresholds.update(4.0, degC, 29.0));
  EXPECT_FALSE(thresholds.update(63.9, degC, 29.0));
  EXPECT_TRUE(thresholds.update(64.0, degC, 29.0));
  EXPECT_EQ(thresholds.status().guardCounts, 10);
  EXPECT_TRUE(thresholds.update(124.0, degC, 29.0));
  EXPECT_FALSE(thresholds.status().guarding);
  EXPECT_EQ(thresholds.proposed().counts, (std::vector{53, 58}));
}

TEST(NoiseThreshold, TheGuardStopsAtItsLimit) {
  NoiseThresholds thresholds = twoMatrices({.maxCounts = 70});
  const std::vector<double> degC = {0.0, 40.0, 30.0};
  int settings = 0;
  for (double t = 0.0; t < 60.0; t += 0.5) settings += thresholds.update(t, degC, 3.0) ? 1 : 0;
  EXPECT_TRUE(thresholds.status().guardAtLimit);
  for (const int counts : thresholds.proposed().counts) EXPECT_EQ(counts, 70);
  EXPECT_LE(settings, 30);
  EXPECT_LE(thresholds.status().guardCounts, 250);
}

TEST(NoiseThreshold, KeepsTheResetValueWhereNothingIsKnown) {
  NoiseThresholds thresholds = twoMatrices();
  const auto set = thresholds.update(0.0, std::vector{0.0, 0.0, kUnknown}, kUnknown);
  ASSERT_TRUE(set);
  EXPECT_EQ(set->counts, (std::vector{150, 300}));
  EXPECT_EQ(thresholds.status().unknown, (std::vector<std::size_t>{0, 1}));
  NoiseThresholds fewer({}, {1, 2}, {0.5, {150, 300}}, 30.0);
  EXPECT_EQ(fewer.update(0.0, std::vector{0.0, 40.0, 40.0}, 30.0)->counts, (std::vector{150, 300}));
}

TEST(NoiseThreshold, SaysWhereItExtrapolates) {
  NoiseThresholds thresholds = twoMatrices();
  thresholds.update(0.0, std::vector{0.0, 60.0, 30.0}, 30.0);
  EXPECT_EQ(thresholds.status().extrapolated, (std::vector<std::size_t>{0}));
}

TEST(NoiseThreshold, RefusesBadOptions) {
  EXPECT_THROW(twoMatrices({.sigmas = -1.0}), std::invalid_argument);
  EXPECT_THROW(twoMatrices({.sensitivity = 1.5}), std::invalid_argument);
  EXPECT_THROW(twoMatrices({.minCounts = 2000}), std::invalid_argument);
  EXPECT_THROW(twoMatrices({.hysteresisCounts = 0}), std::invalid_argument);
  EXPECT_THROW(twoMatrices({.rateCollapseFraction = 2.0}), std::invalid_argument);
  EXPECT_THROW(twoMatrices({.guardWindowS = 0.0}), std::invalid_argument);
  EXPECT_THROW(twoMatrices({.guardStepCounts = 0}), std::invalid_argument);
  EXPECT_THROW(NoiseThresholds(floorOfTwo(), {1}, {0.5, {150, 300}}, 30.0), std::invalid_argument);
  EXPECT_THROW(NoiseThresholds(floorOfTwo(), {1}, {0.5, {150}}, 30.0), std::invalid_argument);
  EXPECT_THROW(NoiseThresholds(floorOfTwo(), {1, 2}, {0.5, {150, 300}}, 0.0),
               std::invalid_argument);
}

}  // namespace
}  // namespace palpate::noise_threshold_test

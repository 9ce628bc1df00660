#include "palpate/emulator/sensor_model.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace palpate {
namespace {

constexpr std::size_t kPlaces = 486;
const std::vector<double> kTemperatures(6, 36.0);

class SensorModelTest : public ::testing::Test {
 protected:
  SensorModel sensor{sdh2(), sdh2Sensor(), 3};
  std::vector<double> pressure = std::vector<double>(kPlaces, 0.0);
  std::vector<std::uint16_t> counts = std::vector<std::uint16_t>(kPlaces);

  void settle(double seconds = 60.0) { sensor.advance(pressure, seconds); }
  void scan(double degC = 36.0) { sensor.scan(std::vector<double>(6, degC), counts); }
  void setThresholds(int threshold) {
    for (MatrixSetting& setting : sensor.settings()) setting.thresholdCounts = threshold;
  }
  void setSensitivities(double sensitivity) {
    for (MatrixSetting& setting : sensor.settings()) setting.sensitivity = sensitivity;
  }
  std::size_t runLengthUnits() const {
    std::size_t units = 0;
    for (std::size_t i = 0; i < kPlaces; ++units) {
      std::size_t run = 1;
      while (run < 15 && i + run < kPlaces && counts[i + run] == counts[i]) ++run;
      i += run;
    }
    return units;
  }
};

TEST_F(SensorModelTest, UnloadedAtDefaultThresholdsItReadsZero) {
  for (int i = 0; i < 200; ++i) {
    scan();
    EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0), 0);
  }
  EXPECT_EQ(runLengthUnits(), 33u) << "486 = 32 x 15 + 6";
}

// The 65-minute recording at threshold 0: 29..72 counts, 306..349 units per frame.
TEST_F(SensorModelTest, AtThresholdZeroItReadsTheNoiseOfTheRealHand) {
  setThresholds(0);
  double units = 0.0;
  for (int i = 0; i < 200; ++i) {
    scan(20.5 + 40.0 * i / 200.0);
    units += static_cast<double>(runLengthUnits()) / 200.0;
    std::size_t place = 0;
    for (const MatrixLayout& matrix : sdh2().layout->matrices())
      for (const std::uint8_t exists : matrix.staticMask) {
        if (exists == 0) {
          EXPECT_EQ(counts[place], 0);
        } else {
          EXPECT_GE(counts[place], 27);
          EXPECT_LE(counts[place], 74);
        }
        ++place;
      }
  }
  EXPECT_GT(units, 306.0);
  EXPECT_LT(units, 349.0);
}

// The noise lines of the study: the mean over many frames of the matrix' maximum.
TEST_F(SensorModelTest, TheMaximumOfAMatrixLiesOnItsNoiseLine) {
  setThresholds(0);
  for (const double degC : {25.0, 40.0, 55.0}) {
    std::vector<double> sum(6, 0.0);
    constexpr int kFrames = 400;
    for (int i = 0; i < kFrames; ++i) {
      scan(degC);
      for (std::size_t m = 0; m < 6; ++m) {
        const auto from = counts.begin() + static_cast<std::ptrdiff_t>(sdh2().layout->offset(m));
        sum[m] += *std::max_element(
            from, from + static_cast<std::ptrdiff_t>(sdh2().layout->matrix(m).numPlaces()));
      }
    }
    for (std::size_t m = 0; m < 6; ++m) {
      const MatrixCharacteristics& line = sdh2Sensor().matrices[m];
      EXPECT_NEAR(sum[m] / kFrames, line.noiseIntercept + line.noiseSlope * degC, 1.6) << m;
    }
  }
}

// Two lags in a row, by their closed form, and the creep on top.
TEST_F(SensorModelTest, AStepIsAnsweredAsSecondOrderLagWithCreep) {
  pressure[20] = 100.0;
  const SensorCharacteristics& c = sdh2Sensor();
  double t = 0.0;
  for (const double dt : {0.001, 0.02, 0.03, 0.05, 0.1, 0.3, 1.0}) {
    sensor.advance(pressure, dt);
    t += dt;
    const double lag =
        100.0 * (1.0 - (c.lag1S * std::exp(-t / c.lag1S) - c.lag2S * std::exp(-t / c.lag2S)) /
                           (c.lag1S - c.lag2S));
    EXPECT_GE(sensor.responseKpa(20), lag - 1e-9) << t;
    EXPECT_LE(sensor.responseKpa(20),
              lag * (1.0 + c.creepShare * (1.0 - std::exp(-t / c.creepS))) + 0.2)
        << t;
  }
  settle(100.0);
  EXPECT_NEAR(sensor.responseKpa(20), 100.0 * (1.0 + c.creepShare), 1e-6);
  EXPECT_EQ(sensor.responseKpa(21), 0.0);
  pressure[20] = 0.0;
  settle(1000.0);
  EXPECT_EQ(sensor.responseKpa(20), 0.0);
}

// 700 g on 1.1 cm^2 (62.3 kPa) at sensitivity 1 and threshold 100 read 589.3 - 11.4 counts; proportional
// to sensitivity. Within a tenth: the recordings differ by as much.
TEST_F(SensorModelTest, KnownPressureReadsTheMeasuredCounts) {
  setThresholds(100);
  for (const double sensitivity : {0.3, 0.5, 1.0}) {
    setSensitivities(sensitivity);
    pressure[84 + 40] = 62.286 / (1.0 + sdh2Sensor().creepShare);  // after the creep
    settle();
    scan(32.0);
    const double measured = 589.3 * sensitivity - 11.4;
    EXPECT_NEAR(counts[84 + 40], measured, 0.1 * 589.3) << sensitivity;
  }
}

TEST_F(SensorModelTest, ReadingsBendTowardsTheSaturationAndNeverReach4095) {
  EXPECT_EQ(saturated(1000.0, 3560.0), 1000.0);
  EXPECT_NEAR(saturated(3026.0 + 1e-6, 3560.0), 3026.0, 1e-3) << "without a corner";
  EXPECT_NEAR((saturated(3026.1, 3560.0) - saturated(3026.0, 3560.0)) / 0.1, 1.0, 1e-3);
  EXPECT_LT(saturated(1e6, 3560.0), 3560.0 + 1e-6);
  setSensitivities(1.0);
  double before = 0.0;
  for (double kpa = 50.0; kpa < 5000.0; kpa *= 1.3) {
    pressure[30] = kpa;
    settle();
    scan();
    EXPECT_GE(counts[30] + 4.0, before) << kpa;
    EXPECT_LE(counts[30], 3567) << "the largest reading ever seen";
    before = counts[30];
  }
  EXPECT_GT(before, 3550.0);
}

TEST_F(SensorModelTest, MaskedTaxelsReadZero) {
  std::fill(pressure.begin(), pressure.end(), 200.0);
  settle();
  sensor.settings()[0].dynamicMask[7] = 0;
  scan();
  EXPECT_EQ(counts[7], 0);
  EXPECT_GT(counts[8], 0);
  EXPECT_EQ(counts[84], 0) << "no taxel is there";
}

TEST_F(SensorModelTest, TheSameSeedMakesTheSameNoise) {
  SensorModel same(sdh2(), sdh2Sensor(), 3), other(sdh2(), sdh2Sensor(), 4);
  for (auto* model : {&sensor, &same, &other})
    for (MatrixSetting& setting : model->settings()) setting.thresholdCounts = 0;
  std::vector<std::uint16_t> b(kPlaces), c(kPlaces);
  scan();
  same.scan(kTemperatures, b);
  other.scan(kTemperatures, c);
  EXPECT_EQ(counts, b);
  EXPECT_NE(counts, c);
}

TEST_F(SensorModelTest, WrongSizesAreRefused) {
  EXPECT_THROW(sensor.scan(std::vector<double>(5), counts), std::invalid_argument);
  counts.resize(10);
  EXPECT_THROW(scan(), std::invalid_argument);
  SensorCharacteristics few = sdh2Sensor();
  few.matrices.pop_back();
  EXPECT_THROW(SensorModel(sdh2(), few), std::invalid_argument);
}

}  // namespace
}  // namespace palpate

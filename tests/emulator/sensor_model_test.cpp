#include "palpate/emulator/sensor_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numeric>

#include <gtest/gtest.h>

#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/signals/characteristic_signals.h"

#include "testing/testing.h"

namespace palpate::sensor_model_test {
namespace {

constexpr std::size_t kPlaces = 486;
const std::vector<double> kTemperatures(6, 36.0);

class SensorModelTest : public ::testing::Test {
 protected:
  SensorModel sensor{sdh2(), sdh2Sensor(), 3};
  std::vector<double> pressure = std::vector<double>(kPlaces, 0.0);
  std::vector<std::uint16_t> counts = std::vector<std::uint16_t>(kPlaces);

  void settle(double seconds = 60.0) { sensor.advance(pressure, seconds); }
  void scan(double degC = 36.0) { sensor.scan(std::vector<double>(6, degC), degC, counts); }
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

// The 65-minute recording at threshold 0: 29..72 counts over all frames, 292..375 units per frame,
// 330 on average (nine tenths of the frames: 306..349).
TEST_F(SensorModelTest, AtThresholdZeroItReadsTheNoiseOfTheRealHand) {
  setThresholds(0);
  double units = 0.0;
  std::uint16_t least = 4095, most = 0;
  constexpr int kFrames = 1297;
  for (int i = 0; i < kFrames; ++i) {
    scan(20.5 + 37.0 * (1.0 - std::exp(-4.0 * i / kFrames)));  // the hand warms up
    units += static_cast<double>(runLengthUnits()) / kFrames;
    std::size_t place = 0;
    for (const MatrixLayout& matrix : sdh2().layout->matrices())
      for (const std::uint8_t exists : matrix.staticMask) {
        if (exists == 0) {
          EXPECT_EQ(counts[place], 0);
        } else {
          least = std::min(least, counts[place]);
          most = std::max(most, counts[place]);
        }
        ++place;
      }
  }
  EXPECT_NEAR(units, 330.0, 8.0);
  EXPECT_NEAR(least, 29, 3);
  EXPECT_NEAR(most, 72, 5);
}

// Measured in that recording, taxel by taxel: the edges of the proximal pads read higher with more
// noise, the others agree within a tenth of a count.
TEST_F(SensorModelTest, TheEdgesOfTheProximalPadsRestHigherAndLessQuietly) {
  setThresholds(0);
  constexpr int kFrames = 2000;
  std::vector<double> sum(kPlaces, 0.0), squares(kPlaces, 0.0);
  for (int i = 0; i < kFrames; ++i) {
    scan(45.0);
    for (std::size_t p = 0; p < kPlaces; ++p) {
      sum[p] += counts[p];
      squares[p] += double(counts[p]) * counts[p];
    }
  }
  const auto meanOf = [&](std::size_t p) { return sum[p] / kFrames; };
  const auto sdOf = [&](std::size_t p) {
    return std::sqrt(squares[p] / kFrames - meanOf(p) * meanOf(p));
  };
  // Column 0, row 7 (place 42), and its right neighbour; means of the recording at 45 deg C, from
  // its fitted lines.
  const double measured[3][4] = {
      {47.2, 3.1, 41.5, 0.77}, {54.1, 4.0, 36.9, 0.93}, {46.4, 3.27, 39.4, 0.92}};
  for (std::size_t pad = 0; pad < 3; ++pad) {
    const std::size_t edge = sdh2().layout->offset(2 * pad) + 42;
    EXPECT_NEAR(meanOf(edge), measured[pad][0], 0.5);
    EXPECT_NEAR(sdOf(edge), measured[pad][1], 0.25);
    EXPECT_NEAR(meanOf(edge + 1), measured[pad][2], 0.3);
    EXPECT_NEAR(sdOf(edge + 1), measured[pad][3], 0.06);
    EXPECT_LT(sdOf(edge - 6), 1.1) << "the row above it is ordinary";
  }
}

// The noise lines of the study: mean of the matrix' maximum over many frames, at temperatures where
// the recording has many (a fifth of it is below 32).
TEST_F(SensorModelTest, TheMaximumOfAMatrixLiesOnItsNoiseLine) {
  setThresholds(0);
  for (const double degC : {30.0, 42.0, 55.0}) {
    std::vector<double> sum(6, 0.0);
    constexpr int kFrames = 400;
    for (int i = 0; i < kFrames; ++i) {
      scan(degC);
      for (std::size_t m = 0; m < 6; ++m) {
        const auto from = counts.begin() + static_cast<std::ptrdiff_t>(sdh2().layout->offset(m));
        sum[m] += *std::max_element(
            from, from + static_cast<std::ptrdiff_t>(sdh2().layout->matrix(m).numCells()));
      }
    }
    for (std::size_t m = 0; m < 6; ++m) {
      const MatrixCharacteristics& line = sdh2Sensor().matrices[m];
      EXPECT_NEAR(sum[m] / kFrames, line.noiseIntercept + line.noiseSlope * degC, 1.0) << m;
    }
  }
}

// Closed form of two lags in series, plus the creep.
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
              lag * (1.0 + c.creepFraction * (1.0 - std::exp(-t / c.creepS))) + 0.2)
        << t;
  }
  settle(100.0);
  EXPECT_NEAR(sensor.responseKpa(20), 100.0 * (1.0 + c.creepFraction), 1e-6);
  EXPECT_EQ(sensor.responseKpa(21), 0.0);
  pressure[20] = 0.0;
  settle(1000.0);
  EXPECT_EQ(sensor.responseKpa(20), 0.0);
}

// Measurement of the study: a stamp of 10.5 mm x 10.5 mm on the flat part of matrix 1 at threshold
// 100; its signal is the mean of the Gaussian-filtered active taxels (eq. 3.2), without the later
// drift.
class Stamp {
 public:
  Stamp() { without_.creepFraction = 0.0; }

  // Mean over nine positions of the stamp between the taxels.
  double signal(double kpa, double sensitivity, double motorDegC, double handDegC) {
    double sum = 0.0;
    for (int i = 0; i < 9; ++i) {
      SensorModel sensor(sdh2(), without_, 1);
      sensor.settings()[1].thresholdCounts = 100;
      sensor.settings()[1].sensitivity = sensitivity;
      std::vector<double> pressure(kPlaces, 0.0);
      press(pressure, kpa, 2.0 + (i % 3) / 3.0, 8.5 + (i / 3) / 3.0);
      spreadPressure(*sdh2().layout, without_.neighbourFraction, pressure);
      sensor.advance(pressure, 60.0);
      std::vector<std::uint16_t> counts(kPlaces);
      sensor.scan(std::vector<double>(6, motorDegC), handDegC, counts);
      TactileFrame frame(sdh2().layout);
      std::copy(counts.begin(), counts.end(), frame.values.begin());
      sum += characteristicSignals(frame)[1].filteredMean;
    }
    return sum / 9.0;
  }

 private:
  // Fraction of each taxel that the stamp covers.
  static void press(std::vector<double>& pressure, double kpa, double x, double y) {
    constexpr double kHalf = 10.5 / 3.4 / 2.0;
    const auto covered = [](double middle, int at) {
      return std::clamp(
          std::min(at + 0.5, middle + kHalf) - std::max(at - 0.5, middle - kHalf), 0.0, 1.0);
    };
    for (int row = 0; row < 13; ++row)
      for (int column = 0; column < 6; ++column)
        pressure[static_cast<std::size_t>(84 + 6 * row + column)] =
            kpa * covered(y, row) * covered(x, column);
  }

  SensorCharacteristics without_ = sdh2Sensor();
};

// K of 24 measured loading steps at three temperatures; the study's own plane has an error of 28
// counts rms.
TEST_F(SensorModelTest, LoadingStepsReadWhatWasMeasured) {
  const auto golden = testing::goldenFolder();
  PALPATE_NEED(golden);
  std::ifstream file(*golden / "pressure_calibration.csv");
  std::string line;
  std::getline(file, line);
  Stamp stamp;
  double bias = 0.0, squares = 0.0;
  int steps = 0;
  while (std::getline(file, line)) {
    std::vector<std::string> fields(1);
    for (const char c : line)
      if (c == ',')
        fields.emplace_back();
      else if (c != '\r')
        fields.back() += c;
    ASSERT_EQ(fields.size(), 10u) << line;
    const double kpa = parseDouble(fields[3]).value(), measured = parseDouble(fields[4]).value();
    const double off =
        stamp.signal(kpa, 1.0, parseDouble(fields[9]).value(), parseDouble(fields[8]).value()) -
        measured;
    EXPECT_LT(std::abs(off), 90.0) << line;
    bias += off;
    squares += off * off;
    ++steps;
  }
  ASSERT_EQ(steps, 24);
  EXPECT_LT(std::abs(bias / steps), 8.0);
  EXPECT_LT(std::sqrt(squares / steps), 45.0);
}

// With 700 g on it (62.286 kPa), sensitivity 0.1 to 1.0: measured 589.3 s - 11.4 counts, at 37.1
// deg C (mean of its sensors).
TEST_F(SensorModelTest, SignalsAreProportionalToSensitivityAsMeasured) {
  Stamp stamp;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int i = 1; i <= 10; ++i) {
    const double s = i / 10.0, k = stamp.signal(62.286, s, 33.1, 37.1);
    n += 1;
    sx += s;
    sy += k;
    sxx += s * s;
    sxy += s * k;
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  EXPECT_NEAR(slope, 589.3, 0.1 * 589.3);
  EXPECT_NEAR((sy - slope * sx) / n, -11.4, 20.0);
}

// The contact of a grasped pen falls from 80 to 10 % within 60..90 ms after its release.
TEST_F(SensorModelTest, AReleasedContactIsGoneWithinThreeFrames) {
  pressure[20] = 80.0;
  settle();
  setThresholds(0);
  setSensitivities(1.0);
  scan();
  const double loaded = counts[20];
  pressure[20] = 0.0;
  settle(0.09);
  scan();
  EXPECT_LT(counts[20], 0.1 * loaded);
  // A taxel that is only relieved keeps its fraction of the creep, which continues when loaded
  // again.
  pressure[20] = 80.0;
  settle();
  pressure[20] = 40.0;
  settle(0.5);
  EXPECT_NEAR(sensor.responseKpa(20), 40.0 * (1.0 + sdh2Sensor().creepFraction), 0.01);
}

TEST_F(SensorModelTest, SpreadingKeepsTheSumAndStaysOnTaxels) {
  for (std::size_t i = 0; i < kPlaces; i += 7) pressure[i] = 1.0 + double(i);
  std::size_t place = 0;
  for (const MatrixLayout& matrix : sdh2().layout->matrices())
    for (const std::uint8_t exists : matrix.staticMask)
      if (exists == 0)
        pressure[place++] = 0.0;
      else
        ++place;
  const auto sumOf = [&](std::size_t m) {
    const auto from = pressure.begin() + static_cast<std::ptrdiff_t>(sdh2().layout->offset(m));
    return std::accumulate(
        from, from + static_cast<std::ptrdiff_t>(sdh2().layout->matrix(m).numCells()), 0.0);
  };
  std::vector<double> sums;
  for (std::size_t m = 0; m < 6; ++m) sums.push_back(sumOf(m));
  spreadPressure(*sdh2().layout, 0.1, pressure);
  for (std::size_t m = 0; m < 6; ++m) EXPECT_NEAR(sumOf(m), sums[m], 1e-9);
  EXPECT_EQ(pressure[84], 0.0) << "the cut corner";
  std::fill(pressure.begin(), pressure.end(), 0.0);
  pressure[20] = 10.0;
  spreadPressure(*sdh2().layout, 0.1, pressure);
  EXPECT_DOUBLE_EQ(pressure[20], 6.0);
  for (const std::size_t neighbour : {14u, 19u, 21u, 26u})
    EXPECT_DOUBLE_EQ(pressure[neighbour], 1.0);
  pressure.pop_back();
  EXPECT_THROW(spreadPressure(*sdh2().layout, 0.1, pressure), std::invalid_argument);
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
  same.scan(kTemperatures, 36.0, b);
  other.scan(kTemperatures, 36.0, c);
  EXPECT_EQ(counts, b);
  EXPECT_NE(counts, c);
}

HandDescription padOf(float fullScale, const std::string& unit) {
  HandDescription hand;
  MatrixLayout matrix = MatrixLayout::full(1, 4, 2.0);
  matrix.staticMask[3] = 0;
  hand.layout = std::make_shared<const SensorLayout>(std::vector{matrix});
  hand.matrices.resize(1);
  hand.maximumCounts = fullScale;
  hand.saturationCounts = fullScale;
  hand.unit = unit;
  return hand;
}

// Proportional to the pressure, 2 per kPa; without noise, but with an offset of 5.
SensorCharacteristics linearSensor(double fullScale) {
  SensorCharacteristics sensor;
  sensor.matrices.resize(1);
  sensor.matrices[0].sensitivity = 1.0;
  sensor.matrices[0].restIntercept = 5.0;
  sensor.matrices[0].noiseIntercept = 5.0;
  sensor.pressure[2] = 0.5;
  sensor.largestCounts = fullScale;
  return sensor;
}

TEST(SensorModelMeasure, AMatrixReadsNoMoreThanItsOwnFullScale) {
  HandDescription hand = padOf(1000.0F, "counts");
  hand.layout = std::make_shared<const SensorLayout>(
      std::vector{MatrixLayout::full(1, 1, 2.0), MatrixLayout::full(1, 1, 2.0)});
  hand.matrices.resize(2);
  hand.matrices[1].maximumCounts = 300.0F;
  SensorCharacteristics sensor = linearSensor(1000.0);
  sensor.matrices.resize(2, sensor.matrices[0]);
  SensorModel model(hand, sensor, 1);
  model.advance(std::vector<double>{1e6, 1e6}, 10.0);
  const std::vector<double> degC = {30.0, 30.0};
  std::vector<float> values(2);
  model.measure(degC, 30.0, values);
  EXPECT_EQ(values, (std::vector<float>{1000.0F, 300.0F}));
  for (MatrixSetting& setting : model.settings()) setting.thresholdCounts = 0;
  std::vector<std::uint16_t> counts(2);
  model.scan(degC, 30.0, counts);
  EXPECT_EQ(counts, (std::vector<std::uint16_t>{1000, 300}));
}

TEST(SensorModelMeasure, ValuesAreInTheUnitAndScaleOfTheHand) {
  const std::vector<double> kpa = {0.0, 50.0, 1e6, 50.0};
  const std::vector<double> degC = {30.0};
  std::vector<float> values(4);
  SensorModel counts(padOf(1000.5F, "counts"), linearSensor(1000.5), 1);
  counts.advance(kpa, 10.0);
  counts.measure(degC, 30.0, values);
  // 2 per kPa less the dead zone of 0.05 kPa: 99.9, so 100 whole counts above the offset.
  EXPECT_EQ(values, (std::vector<float>{0.0F, 100.0F, 1000.0F, 0.0F}));
  // In another unit the steps are 1/4096 of the full scale.
  SensorModel newtons(padOf(409.6F, "N"), linearSensor(409.6), 1);
  newtons.advance(kpa, 10.0);
  newtons.measure(degC, 30.0, values);
  EXPECT_EQ(values[0], 0.0F);
  EXPECT_FLOAT_EQ(values[1], 99.9F);
  EXPECT_FLOAT_EQ(values[2], 409.6F);
  EXPECT_EQ(values[3], 0.0F) << "there is no taxel";
  // A threshold takes the place of the offset.
  newtons.settings()[0].thresholdCounts = 25;
  newtons.measure(degC, 30.0, values);
  EXPECT_NEAR(values[1], 79.9F, 0.06F);
  EXPECT_THROW(newtons.measure(degC, 30.0, std::span(values).subspan(1)), std::invalid_argument);
}

// A pad whose readings have three components and a sign, over an offset of their own.
TEST(SensorModelMeasure, ReadingsHaveABaselineAndShear) {
  HandDescription hand = padOf(1000.0F, "counts");
  MatrixLayout matrix = MatrixLayout::full(1, 2, 2.0);
  matrix.touch = {.components = 3, .isSigned = true};
  hand.layout = std::make_shared<const SensorLayout>(std::vector{matrix});
  SensorModel model(hand, linearSensor(1000.0), 1);
  const std::vector<double> degC = {30.0};
  const Baseline rest = model.baseline(degC);
  ASSERT_EQ(rest.rest.size(), 6u);
  for (const float reading : rest.rest) EXPECT_LE(std::abs(reading - 5.0F), 20.0F);
  EXPECT_NE(rest.rest[0], rest.rest[3]) << "each has its own";
  EXPECT_EQ(rest.noise, std::vector<float>(6, 0.0F));
  std::vector<float> values(6);
  const std::vector<std::array<double, 2>> shear = {{0.5, -0.25}};
  model.measure(degC, 30.0, values, shear);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(values[i], rest.rest[i], 0.51F) << i;
  // 2 per kPa less the dead zone of 0.05 kPa.
  model.advance(std::vector<double>{50.0, 0.0}, 10.0);
  model.measure(degC, 30.0, values, shear);
  const float signal[] = {49.95F, -24.975F, 99.9F, 0.0F, 0.0F, 0.0F};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(values[i] - rest.rest[i], signal[i], 0.51F) << i;
  // Both ends of the scale.
  model.advance(std::vector<double>{1e6, 0.0}, 10.0);
  model.measure(degC, 30.0, values, std::vector<std::array<double, 2>>{{-1.0, 0.0}});
  EXPECT_EQ(values[0], -1000.0F);
  EXPECT_EQ(values[2], 1000.0F);
  model.settings()[0].dynamicMask[0] = 0;
  model.measure(degC, 30.0, values);
  EXPECT_EQ(values[2], 0.0F) << "not scanned";
  EXPECT_THROW(model.measure(degC, 30.0, std::span(values).subspan(3)), std::invalid_argument);
  EXPECT_THROW(model.baseline({}), std::invalid_argument);
  // Without a sign nothing is below 0.
  matrix.touch = {.components = 1, .isSigned = false, .threshold = 2.0F};
  hand.layout = std::make_shared<const SensorLayout>(std::vector{matrix});
  SensorCharacteristics noisy = linearSensor(1000.0);
  noisy.matrices[0].restIntercept = 0.0;
  noisy.matrices[0].taxelSd = 30.0;
  SensorModel above(hand, noisy, 1);
  EXPECT_EQ(above.baseline(degC).noise, std::vector<float>(2, 30.0F));
  std::vector<float> two(2);
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < 500; ++i) {
    above.measure(degC, 30.0, two);
    EXPECT_GE(two[0], 0.0F);
    const auto value = static_cast<double>(two[0]);
    sum += value;
    squares += value * value;
  }
  EXPECT_GT(std::sqrt(squares / 500 - sum * sum / 250'000), 10.0) << "noise";
}

TEST(SensorModelMeasure, EqualOrNoTimeConstantsAreTheLimitOfUnequalOnes) {
  const std::vector<double> kpa = {100.0, 0.0, 0.0, 0.0};
  const auto after = [&](double lag1S, double lag2S, double timeS) {
    SensorCharacteristics sensor = linearSensor(1000.0);
    sensor.lag1S = lag1S;
    sensor.lag2S = lag2S;
    SensorModel model(padOf(1000.0F, "counts"), sensor, 1);
    model.advance(kpa, timeS);
    return model.responseKpa(0);
  };
  EXPECT_EQ(after(0.0, 0.0, 0.01), 100.0);
  EXPECT_NEAR(after(0.1, 0.0, 0.1), 100.0 * (1.0 - std::exp(-1.0)), 1e-9);
  EXPECT_NEAR(after(0.0, 0.1, 0.1), 100.0 * (1.0 - std::exp(-1.0)), 1e-9);
  // Two equal lags in series: 1 - (1 + t/T) exp(-t/T).
  EXPECT_NEAR(after(0.1, 0.1, 0.1), 100.0 * (1.0 - 2.0 * std::exp(-1.0)), 1e-9);
  EXPECT_NEAR(after(0.1, 0.1 * (1.0 + 1e-6), 0.1), after(0.1, 0.1, 0.1), 1e-3);
}

TEST_F(SensorModelTest, WrongSizesAreRefused) {
  EXPECT_THROW(sensor.scan(std::vector<double>(5), 36.0, counts), std::invalid_argument);
  sensor.settings()[2].dynamicMask.pop_back();
  EXPECT_THROW(scan(), std::invalid_argument);
  counts.resize(10);
  EXPECT_THROW(scan(), std::invalid_argument);
  SensorCharacteristics few = sdh2Sensor();
  few.matrices.pop_back();
  EXPECT_THROW(SensorModel(sdh2(), few), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::sensor_model_test

#include "palpate/calibration/pressure_map.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "palpate/device/sdh2.h"
#include "palpate/signals/characteristic_signals.h"

#include "testing/testing.h"

namespace palpate::pressure_map_test {
namespace {

// P = 20 - .5 T + .1 K, exactly but for +-.5 kPa; no drift.
Calibration example(double area = 0.0) {
  Calibration calibration;
  calibration.matrix = 1;
  int i = 0;
  for (const double t : {28.0, 36.0, 44.0})
    for (double k = 50.0; k <= 850.0; k += 100.0) {
      PressureSample s;
      s.staticResponseCounts = k;
      s.driftCountsPerS = 0.0;
      s.nearestDegC = t;
      s.pressureKpa = 20.0 - 0.5 * t + 0.1 * k + (i++ % 2 == 0 ? 0.5 : -0.5);
      s.activeAreaMm2 = 220.5;
      calibration.samples.push_back(s);
    }
  PressureModelOptions options;
  options.indenterAreaMm2 = area;
  calibration.pressure = fitPressureModel(calibration.samples, options);
  return calibration;
}

// A bump on matrix m.
TactileFrame bump(std::size_t m, float peak, std::int64_t hostUs = 0) {
  TactileFrame frame(sdh2().layout);
  frame.hostUs = hostUs;
  auto values = frame.matrix(m);
  for (Eigen::Index y = 5; y <= 8; ++y)
    for (Eigen::Index x = 1; x <= 4; ++x)
      values(y, x) = std::round(
          peak * (1.0F - 0.1F * static_cast<float>((y - 6) * (y - 6) + (x - 2) * (x - 2))));
  return frame;
}

const std::vector<double> kWarm = {30, 36, 36, 36, 36, 36, 36, 50, 50};

TEST(PressureMap, UsesTheFilteredMeanAsTheStudyDoes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> counts(0.0F, 900.0F);
  std::bernoulli_distribution on(0.3);
  PressureMap map(example(), sdh2());
  PressureFrame out;
  for (int run = 0; run < 50; ++run) {
    TactileFrame frame(sdh2().layout);
    for (std::size_t m = 0; m < 6; ++m)
      for (Eigen::Index y = 0; y < frame.matrix(m).rows(); ++y)
        for (Eigen::Index x = 0; x < frame.matrix(m).cols(); ++x)
          if (sdh2().layout->matrix(m).enabled(static_cast<int>(y), static_cast<int>(x)) &&
              on(random))
            frame.matrix(m)(y, x) = counts(random);
    map.apply(frame, kWarm, out);
    const auto signals = characteristicSignals(frame);
    for (std::size_t m = 0; m < 6; ++m) {
      EXPECT_NEAR(out.matrices[m].staticResponseCounts,
                  signals[m].filteredMean,
                  1e-4 * signals[m].filteredMean)
          << m;
      EXPECT_EQ(out.matrices[m].active, signals[m].active);
    }
  }
}

TEST(PressureMap, SubtractsCreepForAsLongAsItWasMeasured) {
  Calibration calibration = example();
  for (PressureSample& sample : calibration.samples) {
    sample.driftCountsPerS = 0.02 * sample.staticResponseCounts;
    sample.durationS = 8.0;
  }
  calibration.pressure = fitPressureModel(calibration.samples);
  PressureMap map(calibration, sdh2());
  PressureFrame out;
  const auto gainAt = [&](double seconds) {
    map.apply(bump(2, 800.0F, std::llround(seconds * 1e6)), kWarm, out);
    return out.matrices[2].staticResponseCounts;
  };
  map.apply(TactileFrame(sdh2().layout), kWarm, out);
  const double reading = gainAt(1.0);
  double gain = 0.0;
  for (double t = 1.1; t < 5.05; t += 0.1) gain = gainAt(t);
  EXPECT_NEAR(gain, reading / 1.08, 0.01 * reading) << "K + .02 K * 4 s is the reading";
  for (double t = 5.1; t < 40.0; t += 0.1) gain = gainAt(t);
  EXPECT_NEAR(gain, reading / 1.16, 0.01 * reading) << "not more than in the 8 s";
}

TEST(PressureMap, SpreadsAContactOverItsTaxelsInProportionToCounts) {
  PressureMap map(example(), sdh2());
  const TactileFrame frame = bump(2, 800.0F);
  PressureFrame out;
  map.apply(frame, kWarm, out);
  const MatrixPressure& contact = out.matrices[2];
  const double k = characteristicSignals(frame)[2].filteredMean;
  EXPECT_NEAR(contact.kpa, 20.0 - 18.0 + 0.1 * k, 0.3);
  const std::size_t offset = sdh2().layout->offset(2);
  double sum = 0.0, ratio = 0.0;
  for (std::size_t p = 0; p < frame.values.size(); ++p) {
    if (frame.values[p] == 0.0F) {
      EXPECT_EQ(out.kpa[p], 0.0F);
      continue;
    }
    EXPECT_GE(p, offset);
    const double r = static_cast<double>(out.kpa[p] / frame.values[p]);
    if (ratio == 0.0) ratio = r;
    EXPECT_NEAR(r, ratio, 1e-6 * ratio);
    sum += static_cast<double>(out.kpa[p]);
  }
  EXPECT_NEAR(sum / contact.active, contact.kpa, 1e-4)
      << "the mean over the contact is its pressure";
  // Newtons: kPa times taxel area 11.56 mm^2, 1e-3 N per kPa mm^2.
  EXPECT_NEAR(contact.forceN, sum * 11.56e-3, 1e-5);
  EXPECT_NEAR(out.forceN, contact.forceN, 1e-12);
  EXPECT_NEAR(contact.sdForceN, contact.sdKpa * contact.active * 11.56e-3, 1e-9);
  EXPECT_TRUE(out.inRange);
}

TEST(PressureMap, AnUnloadedHandHasNoForceAndIsInRange) {
  PressureMap map(example(), sdh2());
  PressureFrame out;
  map.apply(TactileFrame(sdh2().layout), kWarm, out);
  EXPECT_EQ(out.forceN, 0.0);
  EXPECT_EQ(out.sdForceN, 0.0);
  EXPECT_TRUE(out.inRange);
  for (const float kpa : out.kpa) EXPECT_EQ(kpa, 0.0F);
}

TEST(PressureMap, CountsTheAreaThatTheLoadCovers) {
  const TactileFrame frame = bump(1, 800.0F);
  PressureFrame whole, share;
  PressureMap(example(), sdh2()).apply(frame, kWarm, whole);
  PressureMap(example(110.25), sdh2()).apply(frame, kWarm, share);
  EXPECT_NEAR(share.forceN, 0.5 * whole.forceN, 1e-9);
  EXPECT_EQ(share.matrices[1].kpa, whole.matrices[1].kpa);
}

TEST(PressureMap, FlagsWhatItCantKnow) {
  PressureMap map(example(), sdh2());
  PressureFrame known, unknown, light;
  map.apply(bump(0, 800.0F), kWarm, known);
  map.apply(bump(0, 800.0F), {}, unknown);
  EXPECT_FALSE(unknown.temperatureKnown);
  EXPECT_GT(unknown.sdForceN, 2.0 * known.sdForceN);
  map.apply(bump(0, 10.0F), kWarm, light);
  EXPECT_FALSE(light.inRange) << "lighter than anything measured";
  TactileFrame saturated = bump(0, 800.0F);
  saturated.matrix(0)(6, 2) = 3560.0F;
  map.apply(saturated, kWarm, known);
  EXPECT_TRUE(known.matrices[0].saturated);
}

TEST(PressureMap, ValuesThatAreNoNumbersCountAsUnloaded) {
  PressureMap map(example(), sdh2());
  TactileFrame frame = bump(0, 800.0F), broken = frame;
  broken.values[0] = std::numeric_limits<float>::quiet_NaN();
  broken.values[1] = std::numeric_limits<float>::infinity();
  broken.values[2] = -5.0F;
  PressureFrame a, b;
  map.apply(frame, kWarm, a);
  map.apply(broken, kWarm, b);
  EXPECT_EQ(a.forceN, b.forceN);
  EXPECT_EQ(b.kpa[0], 0.0F);
}

TEST(PressureMap, ConvertsTheSensitivityAndWidensForAnotherThreshold) {
  Calibration calibration = example();
  calibration.settings = {1.0, 100.0, true};
  calibration.sensitivityOffset = -10.0;
  const TactileFrame frame = bump(1, 400.0F);
  const double k = characteristicSignals(frame)[1].filteredMean;
  PressureFrame half, same, other;
  PressureMap(calibration, sdh2(), {.settings = {{0.5, 100.0, true}}}).apply(frame, kWarm, half);
  EXPECT_NEAR(half.matrices[1].staticResponseCounts, 2.0 * (k + 10.0) - 10.0, 1e-2);
  PressureMap(calibration, sdh2()).apply(frame, kWarm, same);
  PressureMap(calibration, sdh2(), {.settings = {{1.0, 150.0, true}}}).apply(frame, kWarm, other);
  EXPECT_NEAR(other.matrices[1].sdKpa, std::hypot(same.matrices[1].sdKpa, 5.0), 0.1)
      << "50 counts are 5 kPa";
  EXPECT_FALSE(other.inRange);
  EXPECT_GE(
      PressureMap(calibration, sdh2(), {.settings = {{0.5, 150.0, true}}}).assumptions().size(),
      4u);
}

// A calibration belongs to a hand and to one sensor of this kind.
TEST(PressureMap, SaysThatItWasMeasuredOnAnotherHandOrSensor) {
  const auto saidFirst = [](const Calibration& calibration, const std::string& serial) {
    return PressureMap(calibration, sdh2(), {.serial = serial}).assumptions().front();
  };
  Calibration calibration = example();
  calibration.hand = sdh2().name;
  const std::string usual = saidFirst(calibration, "A1");
  EXPECT_NE(usual.find("measured on matrix"), std::string::npos);
  calibration.serial = "A1";
  EXPECT_EQ(saidFirst(calibration, "A1"), usual);
  EXPECT_EQ(saidFirst(calibration, ""), usual) << "not known";
  EXPECT_EQ(
      saidFirst(calibration, "B2"),
      "measured on the sensor with serial number A1; this one (B2) is assumed to answer alike");
  EXPECT_EQ(calibrationFrom(Json::parse(jsonOf(calibration).text())).serial, "A1");
  calibration.hand = "My pad";
  EXPECT_EQ(saidFirst(calibration, "A1"),
            "measured on 'My pad'; this is '" + sdh2().name +
                "', whose readings may stand for other pressures");
}

TEST(PressureMap, ServesSensorsOfAnyWidth) {
  HandDescription wide;
  wide.layout = std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(3, 100, 2.0)});
  TactileFrame frame(wide.layout);
  frame.matrix(0)(1, 70) = 500.0F;
  frame.matrix(0)(1, 71) = 700.0F;
  PressureFrame out;
  PressureMap(example(), wide).apply(frame, {}, out);
  EXPECT_NEAR(
      out.matrices[0].staticResponseCounts, characteristicSignals(frame)[0].filteredMean, 1e-3);
  EXPECT_FALSE(out.temperatureKnown);
}

TEST(PressureMap, RefusesWhatDoesNotFit) {
  EXPECT_THROW(PressureMap({}, sdh2()), std::invalid_argument);
  EXPECT_THROW(PressureMap(example(), sdh2(), {.settings = {{1.0, 100.0}, {1.0, 100.0}}}),
               std::invalid_argument);
  EXPECT_THROW(PressureMap(example(), sdh2(), {.settings = {{0.0, 100.0}}}), std::invalid_argument);
  PressureMap map(example(), sdh2());
  PressureFrame out;
  TactileFrame other(std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(2, 2, 3.4)}));
  EXPECT_THROW(map.apply(other, kWarm, out), std::invalid_argument);
}

TEST(KnownForce, IsNothingOutsideTheRangeAndWithoutTheArea) {
  const MatrixPressure touched{.active = 3, .forceN = 2.5}, free{};
  MatrixPressure beyond = touched;
  beyond.inRange = false;
  EXPECT_EQ(knownForceN(touched, true), 2.5);
  EXPECT_EQ(knownForceN(touched, false), std::nullopt);
  EXPECT_EQ(knownForceN(beyond, true), std::nullopt);
  EXPECT_EQ(knownForceN(free, false), 0.0);
  PressureFrame frame;
  frame.matrices = {touched, free};
  frame.forceN = 2.5;
  EXPECT_EQ(knownForceN(frame), 2.5);
  frame.areaKnown = false;
  EXPECT_EQ(knownForceN(frame), std::nullopt);
  frame.areaKnown = true;
  frame.inRange = false;
  EXPECT_EQ(knownForceN(frame), std::nullopt);
  frame.matrices = {free, free};
  frame.forceN = 0.0;
  EXPECT_EQ(knownForceN(frame), 0.0);
}

}  // namespace
}  // namespace palpate::pressure_map_test

// The whole way on the emulated sensor, whose truth is known: weights on a stamp at three temperatures, steps found and
// fitted, the pressure model made, other weights at other temperatures read back within the stated band.
#include <algorithm>
#include <cmath>

#include "palpate/calibration/pressure_map.h"
#include "palpate/calibration/pressure_table.h"
#include "palpate/calibration/step_report.h"
#include "palpate/emulator/sensor_model.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate {
namespace {

constexpr std::size_t kMatrix = 1;
constexpr double kStampMm = 10.5, kStampMm2 = kStampMm * kStampMm;  // the study's
constexpr double kTopMm = 18.2, kLeftMm = 6.1;                      // it stands between taxels
constexpr double kRateHz = 31.7;

// Rest for a second, then so much pressure on the stamp, at sensitivity 1 and threshold 100.
Profile stamped(double kpa, double degC, std::uint64_t seed, double holdS = 12.0) {
  const HandDescription& hand = sdh2();
  SensorModel model(hand, sdh2Sensor(), seed);
  for (MatrixSetting& setting : model.settings()) {
    setting.sensitivity = 1.0;
    setting.thresholdCounts = 100;
  }
  std::vector<double> none(hand.layout->numPlaces(), 0.0), loaded = none;
  const auto covered = [](std::size_t place, double fromMm) {
    const double low = std::max(3.4 * static_cast<double>(place), fromMm);
    return std::max(std::min(3.4 * static_cast<double>(place + 1), fromMm + kStampMm) - low, 0.0) /
           3.4;
  };
  for (std::size_t y = 0; y < 13; ++y)
    for (std::size_t x = 0; x < 6; ++x)
      loaded[hand.layout->offset(kMatrix) + y * 6 + x] =
          kpa * covered(y, kTopMm) * covered(x, kLeftMm);
  spreadPressure(*hand.layout, sdh2Sensor().spreadShare, loaded);
  ProfileBuilder builder(hand.layout);
  std::vector<std::uint16_t> counts(none.size());
  std::vector<float> values(none.size());
  const std::vector<double> motors(6, degC), all(9, degC);
  builder.addTemperatures(1, all);
  for (int i = 0; i < (1.0 + holdS) * kRateHz; ++i) {
    model.advance(i < kRateHz ? none : loaded, 1.0 / kRateHz);
    model.scan(motors, degC, counts);
    std::copy(counts.begin(), counts.end(), values.begin());
    builder.addFrame(1'000'000 + static_cast<std::int64_t>(1e6 * i / kRateHz), values);
  }
  return builder.finish({});
}

Calibration calibrated() {
  Calibration calibration;
  calibration.matrix = kMatrix;
  std::vector<StepReport> reports;
  std::uint64_t seed = 1;
  for (const double degC : {29.0, 36.0, 43.0})
    for (double kpa = 20.0; kpa <= 80.0; kpa += 7.5) {
      reports.push_back(reportSteps(stamped(kpa, degC, seed++), kMatrix));
      for (PressureSample& sample :
           samplesOf({.file = "emulated", .pressureKpa = kpa}, reports.back(), ""))
        calibration.samples.push_back(std::move(sample));
    }
  PressureModelOptions options;
  options.stampAreaMm2 = kStampMm2;
  calibration.pressure = fitPressureModel(calibration.samples, options);
  calibration.pressure.steadyS = medianSteadyS(reports);
  return calibration;
}

TEST(EmulatedPressure, KnownWeightsAreReadBackWithinTheStatedBand) {
  const Calibration calibration = calibrated();
  ASSERT_EQ(calibration.samples.size(), 27u) << "one step per weight";
  for (const PressureSample& sample : calibration.samples) EXPECT_TRUE(sample.used);
  ASSERT_TRUE(calibration.pressure.valid());
  EXPECT_LT(calibration.pressure.gain.looRmse, 3.0) << "as good as the real rig";
  int read = 0, kpaInside = 0, forceInside = 0;
  std::uint64_t seed = 1000;
  for (const double degC : {31.0, 38.0, 41.0})
    for (double kpa = 25.0; kpa <= 70.0; kpa += 5.0) {
      const Profile profile = stamped(kpa, degC, seed++, 6.0);
      PressureMap map(calibration, profile.hand());
      PressureFrame out;
      TactileFrame frame;
      for (std::size_t i = 0; i < profile.numFrames(); ++i) {
        profile.readFrame(i, frame);
        map.apply(frame, profile.temperatures(0).degC, out);
      }
      const MatrixPressure& contact = out.matrices[kMatrix];
      EXPECT_TRUE(contact.inRange) << kpa << " kPa at " << degC;
      EXPECT_TRUE(contact.compensated);
      ++read;
      kpaInside += std::abs(contact.kpa - kpa) <= 2.0 * contact.sdKpa ? 1 : 0;
      const double forceN = kpa * kStampMm2 * 1e-3;
      forceInside += std::abs(contact.forceN - forceN) <= 2.0 * contact.sdForceN ? 1 : 0;
      EXPECT_LT(contact.sdKpa, 5.0);
      for (std::size_t m = 0; m < out.matrices.size(); ++m)
        EXPECT_EQ(out.matrices[m].forceN > 0.0, m == kMatrix);
    }
  EXPECT_GE(kpaInside, 0.9 * read) << "of " << read;
  EXPECT_GE(forceInside, 0.9 * read) << "of " << read;
}

}  // namespace
}  // namespace palpate

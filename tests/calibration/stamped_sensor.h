// A stamp of known pressure on the emulated sensor: recordings, a device that is pressed in the
// same way, and the calibration from such recordings, for tests of calibration.
#pragma once

#include <algorithm>
#include <vector>

#include "palpate/calibration/calibration.h"
#include "palpate/calibration/pressure_table.h"
#include "palpate/calibration/step_report.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/sensor_model.h"
#include "palpate/model/profile_builder.h"

namespace palpate::testing {

inline constexpr std::size_t kMatrix = 1;
inline constexpr double kStampMm = 10.5, kStampMm2 = kStampMm * kStampMm;  // the study's stamp
inline constexpr double kTopMm = 18.2, kLeftMm = 6.1;  // position of the stamp, between taxels
inline constexpr double kRateHz = 31.7;

// Pressure on every place under the stamp, as the rubber distributes it [kPa].
inline std::vector<double> underTheStamp(double kpa) {
  const HandDescription& hand = sdh2();
  std::vector<double> loaded(hand.layout->numCells(), 0.0);
  const auto covered = [](std::size_t place, double fromMm) {
    const double low = std::max(3.4 * static_cast<double>(place), fromMm);
    return std::max(std::min(3.4 * static_cast<double>(place + 1), fromMm + kStampMm) - low, 0.0) /
           3.4;
  };
  for (std::size_t y = 0; y < 13; ++y)
    for (std::size_t x = 0; x < 6; ++x)
      loaded[hand.layout->offset(kMatrix) + y * 6 + x] =
          kpa * covered(y, kTopMm) * covered(x, kLeftMm);
  spreadPressure(*hand.layout, sdh2Sensor().neighbourFraction, loaded);
  return loaded;
}

// A recording with a second of rest, then the pressure on the stamp, at sensitivity 1 and threshold
// 100.
inline Profile stamped(double kpa, double degC, std::uint64_t seed, double holdS = 12.0) {
  const HandDescription& hand = sdh2();
  SensorModel model(hand, sdh2Sensor(), seed);
  for (MatrixSetting& setting : model.settings()) {
    setting.sensitivity = 1.0;
    setting.thresholdCounts = 100;
  }
  const std::vector<double> none(hand.layout->numCells(), 0.0), loaded = underTheStamp(kpa);
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

inline Calibration calibrated() {
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
  options.indenterAreaMm2 = kStampMm2;
  calibration.pressure = fitPressureModel(calibration.samples, options);
  calibration.pressure.steadyS = medianSteadyS(reports);
  return calibration;
}

}  // namespace palpate::testing

// Calibrations with known content, for tests of code that applies calibrations.
#pragma once

#include "palpate/calibration/calibration.h"
#include "palpate/calibration/noise_floor.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

namespace palpate::testing {

// Pressure P = 2 + 0.1 K [kPa], independent of temperature; measured on matrix 1 between 50 and
// 1200 counts.
inline Calibration linearCalibration(const SensorSettings& settings) {
  Calibration made;
  made.hand = sdh2().name;
  made.matrix = 1;
  made.settings = settings;
  for (int i = 0; i < 24; ++i) {
    PressureSample sample;
    sample.staticResponseCounts = 50.0 * (i + 1);
    sample.pressureKpa = 2.0 + 0.1 * sample.staticResponseCounts;
    sample.nearestDegC = 28.0 + i % 5;
    made.samples.push_back(sample);
  }
  made.pressure = fitPressureModel(made.samples, {});
  return made;
}

// Noise floor of all six matrices: intercept + m + slope T, measured from 20 to 60 deg C.
inline NoiseFloor evenNoise(double slope, double intercept, double rmse) {
  NoiseFloor floor;
  for (std::size_t m = 0; m < 6; ++m) {
    NoiseLine line;
    line.matrix = m;
    line.slope = slope;
    line.intercept = intercept + static_cast<double>(m);
    line.rmse = rmse;
    line.valid = true;
    line.minDegC = 20.0;
    line.maxDegC = 60.0;
    floor.lines.push_back(line);
  }
  return floor;
}

}  // namespace palpate::testing

#include "palpate/model/sensor_characteristics.h"

#include <cstddef>

namespace palpate {
namespace {

SensorCharacteristics makeSdh2() {
  SensorCharacteristics sensor;
  // slope, intercept, rmse: lines of the maximum. Below line, sd: from the same recording.
  const double lines[6][5] = {{0.3317, 33.628, 2.425417, 7.17, 0.75},
                              {0.1999, 42.565, 0.708428, 2.06, 0.83},
                              {0.3604, 41.551, 2.894096, 20.19, 0.89},
                              {0.1632, 40.170, 0.930476, 2.64, 0.90},
                              {0.4078, 30.616, 2.646151, 9.21, 0.87},
                              {0.1741, 45.296, 0.850922, 2.48, 0.92}};
  for (const auto& line : lines) {
    const bool proximal = sensor.matrices.size() % 2 == 0;
    MatrixCharacteristics matrix;
    matrix.noiseSlope = line[0];
    matrix.noiseIntercept = line[1];
    matrix.noiseRmse = line[2];
    matrix.meanBelowLine = line[3];
    matrix.taxelSd = line[4];
    if (proximal) {
      matrix.warmPlaces = {42, 48, 78};  // column 0, rows 7, 8, 13
      matrix.warmCounts = line[3] - 1.5;
    }
    matrix.thresholdCounts = proximal ? 150 : 300;
    sensor.matrices.push_back(matrix);
  }
  const double plane[4] = {31.8973801, -0.6249430, 0.0977683, -0.0000386};
  for (std::size_t i = 0; i < 4; ++i) sensor.pressure[i] = plane[i];
  sensor.saturationCounts = 3560.0;
  sensor.lag1S = 0.12;
  sensor.lag2S = 0.04;
  sensor.creepShare =
      0.15;  // 3 % of the step per second at first: the median drift over the 54 steps
  sensor.creepS = 5.0;
  return sensor;
}

}  // namespace

double SensorCharacteristics::gainCountsPerKpa(double degC) const {
  return 1.0 / (pressure[2] + pressure[3] * degC);
}

const SensorCharacteristics& sdh2Sensor() {
  static const SensorCharacteristics sensor = makeSdh2();
  return sensor;
}

}  // namespace palpate

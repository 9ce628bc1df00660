#include "palpate/model/sensor_characteristics.h"

#include <cstddef>

namespace palpate {
namespace {

SensorCharacteristics makeSdh2() {
  SensorCharacteristics sensor;
  // Slope, intercept, rmse of the maximum; slope, intercept of the mean; noise of a taxel.
  const double lines[6][6] = {{0.3317, 33.628, 2.425417, 0.1612, 34.409, 0.74},
                              {0.1999, 42.565, 0.708428, 0.1978, 40.542, 0.72},
                              {0.3604, 41.551, 2.894096, 0.1406, 31.887, 0.78},
                              {0.1632, 40.170, 0.930476, 0.1598, 37.639, 0.79},
                              {0.4078, 30.616, 2.646151, 0.1559, 32.861, 0.72},
                              {0.1741, 45.296, 0.850922, 0.1731, 42.811, 0.80}};
  for (const auto& line : lines) {
    const bool proximal = sensor.matrices.size() % 2 == 0;
    MatrixCharacteristics matrix;
    matrix.noiseSlope = line[0];
    matrix.noiseIntercept = line[1];
    matrix.noiseRmse = line[2];
    matrix.meanSlope = line[3];
    matrix.meanIntercept = line[4];
    matrix.taxelSd = line[5];
    if (proximal) matrix.warmPlaces = {42, 48, 78};  // column 0, rows 7, 8, 13
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

double MatrixCharacteristics::warmAtRest(double degC) const {
  // The largest of a few noisy places lies about one standard deviation above their mean.
  const double above = noiseIntercept + noiseSlope * degC - meanAtRest(degC) - taxelSd;
  return above > 0.0 ? above : 0.0;
}

double SensorCharacteristics::gainCountsPerKpa(double degC) const {
  return 1.0 / (pressure[2] + pressure[3] * degC);
}

const SensorCharacteristics& sdh2Sensor() {
  static const SensorCharacteristics sensor = makeSdh2();
  return sensor;
}

}  // namespace palpate

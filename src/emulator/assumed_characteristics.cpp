#include "palpate/emulator/assumed_characteristics.h"

namespace palpate {

SensorCharacteristics assumedCharacteristics(const HandDescription& hand) {
  const double fullScale = static_cast<double>(hand.maximumCounts);
  MatrixCharacteristics matrix;
  matrix.noiseIntercept = 0.005 * fullScale;
  matrix.noiseRmse = 0.001 * fullScale;
  matrix.restIntercept = 0.002 * fullScale;
  matrix.taxelSd = 0.001 * fullScale;
  matrix.sensitivity = 1.0;
  SensorCharacteristics sensor;
  sensor.matrices.assign(hand.layout->numMatrices(), matrix);
  sensor.pressure[2] = hand.unit == "kPa" ? 1.0 : kAssumedFullScaleKpa / fullScale;
  sensor.largestCounts = fullScale;
  sensor.neighbourFraction = 0.05;
  sensor.lag1S = 0.02;
  sensor.lag2S = 0.005;
  sensor.creepFraction = 0.05;
  sensor.creepS = 5.0;
  sensor.releaseS = 0.02;
  return sensor;
}

}  // namespace palpate

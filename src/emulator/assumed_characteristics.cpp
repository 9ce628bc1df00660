#include "palpate/emulator/assumed_characteristics.h"

namespace palpate {

SensorCharacteristics assumedCharacteristics(const HandDescription& hand) {
  const double fullScale = static_cast<double>(hand.maximumCounts);
  SensorCharacteristics sensor;
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m) {
    const double ownScale = static_cast<double>(hand.maximumOf(m));
    MatrixCharacteristics matrix;
    matrix.noiseIntercept = 0.005 * ownScale;
    matrix.noiseRmse = 0.001 * ownScale;
    matrix.restIntercept = 0.002 * ownScale;
    matrix.taxelSd = 0.001 * ownScale;
    matrix.sensitivity = hand.unit == "counts" ? ownScale / fullScale : 1.0;
    sensor.matrices.push_back(matrix);
  }
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

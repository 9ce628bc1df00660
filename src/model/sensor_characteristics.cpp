#include "palpate/model/sensor_characteristics.h"

#include <algorithm>
#include <cmath>

#include "palpate/model/hand_description.h"

namespace palpate {
namespace {

constexpr double kLeastDeadZoneKpa = 0.05;

// Makes the taxels of column 0, rows 7 to 13 of a proximal pad.
std::vector<OffsetTaxel> raisedEdge(const double (&lines)[7][3]) {
  std::vector<OffsetTaxel> edge;
  for (const auto& [intercept, slope, sd] : lines)
    edge.push_back({42 + 6 * edge.size(), intercept, slope, sd});
  return edge;
}

SensorCharacteristics sensorCharacteristicsMakeSdh2() {
  SensorCharacteristics sensor;
  // Per matrix: slope, intercept and rmse of the maximum; slope, intercept and noise of an ordinary
  // taxel (without the part from rounding); shared noise.
  const double lines[6][7] = {{0.3317, 33.628, 2.425417, 0.152, 34.625, 0.71, 0.12},
                              {0.1999, 42.565, 0.708428, 0.198, 40.542, 0.75, 0.33},
                              {0.3604, 41.551, 2.894096, 0.123, 31.364, 0.86, 0.21},
                              {0.1632, 40.170, 0.930476, 0.160, 37.639, 0.88, 0.22},
                              {0.4078, 30.616, 2.646151, 0.137, 33.239, 0.82, 0.28},
                              {0.1741, 45.296, 0.850922, 0.173, 42.811, 0.88, 0.31}};
  const double edges[3][7][3] = {{{33.01, 0.3162, 3.10},
                                  {31.88, 0.2957, 3.16},
                                  {31.59, 0.2282, 1.89},
                                  {31.69, 0.2469, 2.01},
                                  {31.58, 0.2601, 2.12},
                                  {32.17, 0.2526, 2.18},
                                  {32.25, 0.2537, 2.26}},
                                 {{38.64, 0.3435, 4.00},
                                  {38.27, 0.3414, 3.81},
                                  {36.66, 0.3116, 3.74},
                                  {37.01, 0.3365, 3.66},
                                  {37.56, 0.3289, 3.79},
                                  {38.33, 0.3195, 3.88},
                                  {36.98, 0.3535, 4.03}},
                                 {{28.73, 0.3926, 3.26},
                                  {28.87, 0.3749, 3.12},
                                  {28.07, 0.3236, 2.67},
                                  {28.69, 0.3454, 2.85},
                                  {28.73, 0.3532, 2.93},
                                  {28.84, 0.3572, 3.07},
                                  {29.05, 0.3633, 3.07}}};
  for (const auto& line : lines) {
    const std::size_t m = sensor.matrices.size();
    MatrixCharacteristics matrix;
    matrix.noiseSlope = line[0];
    matrix.noiseIntercept = line[1];
    matrix.noiseRmse = line[2];
    matrix.restSlope = line[3];
    matrix.restIntercept = line[4];
    matrix.taxelSd = line[5];
    matrix.sharedSd = line[6];
    if (m % 2 == 0) matrix.raised = raisedEdge(edges[m / 2]);
    matrix.thresholdCounts = m % 2 == 0 ? 150 : 300;
    sensor.matrices.push_back(matrix);
  }
  const double plane[4] = {31.8973801, -0.6249430, 0.0977683, -0.0000386};
  std::copy(std::begin(plane), std::end(plane), sensor.pressure);
  sensor.countsPerMean = 4.75;
  sensor.thresholdKpa = 1.0;
  sensor.neighbourFraction = 0.10;
  sensor.largestCounts = static_cast<double>(kSdh2LargestCounts);
  sensor.lag1S = 0.12;
  sensor.lag2S = 0.04;
  sensor.creepFraction = 0.15;  // of 5 s: at first 3 % of the step per second
  sensor.creepS = 5.0;
  sensor.releaseS = 0.03;
  return sensor;
}

}  // namespace

double SensorCharacteristics::gainCountsPerKpa(double degC) const {
  return countsPerMean / (pressure[2] + pressure[3] * degC);
}

double SensorCharacteristics::deadZoneKpa(double degC) const {
  return std::max(pressure[0] + pressure[1] * degC - thresholdKpa, kLeastDeadZoneKpa);
}

double SensorCharacteristics::countsAbove(double kpa, double degC) const {
  if (!(kpa > 0.0)) return 0.0;
  const double dead = deadZoneKpa(degC);
  return gainCountsPerKpa(degC) * (kpa + dead * std::expm1(-kpa / dead));
}

const SensorCharacteristics& sdh2Sensor() {
  static const SensorCharacteristics sensor = sensorCharacteristicsMakeSdh2();
  return sensor;
}

}  // namespace palpate

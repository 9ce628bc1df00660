#include "palpate/model/sensor_characteristics.h"

#include <algorithm>
#include <cmath>

namespace palpate {
namespace {

constexpr double kMinDeadZoneKpa = 0.05;

}  // namespace

double SensorCharacteristics::gainCountsPerKpa(double degC) const {
  return countsPerMean / (pressure[2] + pressure[3] * degC);
}

double SensorCharacteristics::deadZoneKpa(double degC) const {
  return std::max(pressure[0] + pressure[1] * degC - thresholdKpa, kMinDeadZoneKpa);
}

double SensorCharacteristics::countsAbove(double kpa, double degC) const {
  if (!(kpa > 0.0)) return 0.0;
  const double dead = deadZoneKpa(degC);
  return gainCountsPerKpa(degC) * (kpa + dead * std::expm1(-kpa / dead));
}

}  // namespace palpate

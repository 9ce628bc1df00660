// The hand beside its taxels: joint angles and temperatures, each a time series of its own.
#pragma once

#include <cstdint>
#include <vector>

namespace palpate {

// One sample of all joints, in the order of the hand's axes (HandDescription::axes).
struct JointAngles {
  std::int64_t hostUs = 0;  // host time [us since 1970]
  std::vector<double> deg;  // joint angles [deg]
};

// One sample of all temperature sensors, in the order of HandDescription::temperatureSensors.
struct Temperatures {
  std::int64_t hostUs = 0;   // host time [us since 1970]
  std::vector<double> degC;  // [deg C]; 0 = the sensor has not reported yet (power-up)
};

}  // namespace palpate

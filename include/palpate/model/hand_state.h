// The state of the hand apart from its taxels: joint angles and temperatures. Each is a time series
// of its own in recordings and live sources.
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
  std::int64_t hostUs = 0;  // host time [us since 1970]
  // Temperatures [deg C]; 0 when the sensor has not reported yet (power-up).
  std::vector<double> degC;
};

}  // namespace palpate

// Names, units and ranges of the values of each vector command of the SDH-2.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "palpate/device/sdh_protocol.h"

namespace palpate {

struct SdhQuantity {
  SdhCommand command;
  const char* noun;  // for messages
  const char* unit;  // " deg"
  // Least value; answers below it are implausible.
  double least;
  double most;
  bool whole = false;  // whole numbers only

  // True if all values are finite and in range, and their number is `count`.
  bool plausible(std::span<const double> values, std::size_t count) const noexcept;
};

namespace sdh {

constexpr double kMaxDeg = 180.0;
constexpr double kMaxDegPerS = 1000.0;
constexpr double kMaxDegPerS2 = 100'000.0;
constexpr double kMaxAmpere = 10.0;

inline constexpr SdhQuantity kAngle{SdhCommand::kAngle, "angle", " deg", -kMaxDeg, kMaxDeg};
inline constexpr SdhQuantity kTarget{
    SdhCommand::kAngleTarget, "target angle", " deg", -kMaxDeg, kMaxDeg};
inline constexpr SdhQuantity kTargetGetAngle{
    SdhCommand::kTargetGetAngle, "target angle", " deg", -kMaxDeg, kMaxDeg};
inline constexpr SdhQuantity kVelocity{
    SdhCommand::kVelocity, "velocity", " deg/s", -kMaxDegPerS, kMaxDegPerS};
inline constexpr SdhQuantity kReferenceVelocity{
    SdhCommand::kVelocityReference, "reference velocity", " deg/s", -kMaxDegPerS, kMaxDegPerS};
inline constexpr SdhQuantity kTargetVelocity{
    SdhCommand::kVelocityTarget, "target velocity", " deg/s", -kMaxDegPerS, kMaxDegPerS};
inline constexpr SdhQuantity kTargetGetVelocity{
    SdhCommand::kTargetGetVelocity, "target velocity", " deg/s", -kMaxDegPerS, kMaxDegPerS};
inline constexpr SdhQuantity kAcceleration{
    SdhCommand::kAcceleration, "acceleration", " deg/s^2", 0.0, kMaxDegPerS2};
inline constexpr SdhQuantity kState{SdhCommand::kState, "state", "", 0.0, 7.0, true};
inline constexpr SdhQuantity kPower{SdhCommand::kPower, "power", "", 0.0, 1.0, true};
inline constexpr SdhQuantity kTemperature{
    SdhCommand::kTemperature, "temperature", " °C", -55.0, 150.0};
inline constexpr SdhQuantity kVelocityLimit{
    SdhCommand::kVelocityLimit, "velocity limit", " deg/s", 1e-3, kMaxDegPerS};
inline constexpr SdhQuantity kAccelerationLimit{
    SdhCommand::kAccelerationLimit, "acceleration limit", " deg/s^2", 1e-3, kMaxDegPerS2};

}  // namespace sdh

// Checks seven values: each must be finite and within `least[axis]`..`most[axis]`. Throws
// std::invalid_argument that names axis, value and range.
void checkSdhValues(const SdhQuantity& quantity,
                    std::span<const double> values,
                    std::span<const double> least,
                    std::span<const double> most);
// As above, with the same range for all axes.
void checkSdhValues(const SdhQuantity& quantity,
                    std::span<const double> values,
                    double least,
                    double most);
// Throws std::invalid_argument unless axis is 0..6.
void checkSdhAxis(std::size_t axis);

}  // namespace palpate

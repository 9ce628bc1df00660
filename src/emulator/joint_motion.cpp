#include "palpate/emulator/joint_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "palpate/core/number_text.h"

namespace palpate {
namespace {

using std::numbers::pi;

constexpr double kPoseVelocity = 40.0;        // at power-up [deg/s]
constexpr double kStartAcceleration = 100.0;  // [deg/s^2]
constexpr double kAtTargetDeg = 1e-9;
// An axis below this fraction of its free speed counts as blocked.
constexpr double kHeld = 0.02;

// The cruising velocity of the trapezoid that covers d in T with acceleration a: d = v (T - v/a).
double cruise(double distance, double durationS, double a) {
  const double root = a * a * durationS * durationS - 4.0 * a * distance;
  return (a * durationS - std::sqrt(std::max(root, 0.0))) / 2.0;
}

}  // namespace

JointMotion::JointMotion(const HandDescription& hand, std::vector<double> startDeg)
    : axes_(hand.axes),
      angleDeg_(std::move(startDeg)),
      velocityDegPerS_(axes_.size()),
      referenceDegPerS_(axes_.size()),
      targetDeg_(angleDeg_),
      targetVelocityDegPerS_(axes_.size(), kPoseVelocity),
      accelerationDegPerS2_(axes_.size(), kStartAcceleration),
      power_(axes_.size()),
      resistsClockwise_(axes_.size()),
      resistsCounterClockwise_(axes_.size()),
      states_(axes_.size(), AxisState::kDisabled),
      paths_(axes_.size()) {
  std::vector<double> least, most;
  for (const AxisDescription& axis : axes_) {
    least.push_back(axis.minimumDeg);
    most.push_back(axis.maximumDeg);
  }
  require("start angle", angleDeg_, least, most);
}

void JointMotion::requireSize(const char* what, std::size_t size) const {
  if (size != axes_.size())
    throw std::invalid_argument(std::string(what) + ": " + std::to_string(size) + " values for " +
                                std::to_string(axes_.size()) + " axes");
}

void JointMotion::require(const char* what,
                          const std::vector<double>& values,
                          const std::vector<double>& least,
                          const std::vector<double>& most) const {
  requireSize(what, values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string which = std::string(what) + " of axis " + std::to_string(i) + ": ";
    if (!std::isfinite(values[i])) throw std::invalid_argument(which + "not a number");
    if (values[i] < least[i] || values[i] > most[i])
      throw std::out_of_range(which + numberText(values[i]) + " is not in " + numberText(least[i]) +
                              ".." + numberText(most[i]));
  }
}

// --- Settings

void JointMotion::setTargets(const std::vector<double>& deg) {
  std::vector<double> least, most;
  for (const AxisDescription& axis : axes_) {
    least.push_back(axis.minimumDeg);
    most.push_back(axis.maximumDeg);
  }
  require("target", deg, least, most);
  targetDeg_ = deg;
}

void JointMotion::setVelocities(const std::vector<double>& degPerS) {
  std::vector<double> least, most;
  for (const AxisDescription& axis : axes_) {
    most.push_back(axis.maximumVelocityDegPerS);
    least.push_back(controller_ == ControllerType::kPose ? 0.0 : -axis.maximumVelocityDegPerS);
  }
  require("velocity", degPerS, least, most);
  if (controller_ != ControllerType::kPose) ++orderCount_;
  targetVelocityDegPerS_ = degPerS;
}

void JointMotion::setAccelerations(const std::vector<double>& degPerS2) {
  std::vector<double> most;
  for (const AxisDescription& axis : axes_) most.push_back(axis.maximumAccelerationDegPerS2);
  require("acceleration", degPerS2, std::vector<double>(axes_.size(), 0.0), most);
  accelerationDegPerS2_ = degPerS2;
}

void JointMotion::setPower(const std::vector<bool>& on) {
  requireSize("power", on.size());
  ++orderCount_;
  switchPower(on);
}

void JointMotion::switchPower(const std::vector<bool>& on) {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (on[i] == power_[i]) continue;
    power_[i] = on[i];
    states_[i] = on[i] ? AxisState::kIdle : AxisState::kDisabled;
    if (on[i]) continue;
    paths_[i].active = false;
    velocityDegPerS_[i] = referenceDegPerS_[i] = 0.0;
    if (controller_ != ControllerType::kPose) targetVelocityDegPerS_[i] = 0.0;
  }
}

void JointMotion::setController(ControllerType type) {
  if (moving()) ++orderCount_;
  halt();
  controller_ = type;
  std::fill(targetVelocityDegPerS_.begin(),
            targetVelocityDegPerS_.end(),
            type == ControllerType::kPose ? kPoseVelocity : 0.0);
}

void JointMotion::setProfile(VelocityProfile profile) { profile_ = profile; }

void JointMotion::setResistance(std::size_t axis, double clockwise, double counterClockwise) {
  resistsClockwise_.at(axis) = std::clamp(clockwise, 0.0, 1.0);
  resistsCounterClockwise_.at(axis) = std::clamp(counterClockwise, 0.0, 1.0);
}

// --- Motion

double JointMotion::axisDuration(std::size_t axis) const {
  const double distance = std::abs(targetDeg_[axis] - angleDeg_[axis]);
  const double v = std::abs(targetVelocityDegPerS_[axis]);
  const double a = accelerationDegPerS2_[axis];
  if (distance < kAtTargetDeg || v <= 0.0 || a <= 0.0) return 0.0;
  if (profile_ == VelocityProfile::kSinSquare)
    return std::max(2.0 * distance / v, std::sqrt(2.0 * pi * distance / a));
  return distance >= v * v / a ? distance / v + v / a : 2.0 * std::sqrt(distance / a);
}

double JointMotion::durationOfPending() const {
  double longest = 0.0;
  for (std::size_t i = 0; i < axes_.size(); ++i) longest = std::max(longest, axisDuration(i));
  return longest;
}

double JointMotion::startMotion() {
  if (controller_ != ControllerType::kPose) return 0.0;
  ++orderCount_;
  switchPower(std::vector<bool>(axes_.size(), true));
  durationS_ = durationOfPending();
  motionProfile_ = profile_;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const bool moves = axisDuration(i) > 0.0;
    paths_[i] = {angleDeg_[i], targetDeg_[i] - angleDeg_[i], accelerationDegPerS2_[i], 0.0, moves};
    states_[i] = moves ? AxisState::kPositioning : AxisState::kIdle;
    velocityDegPerS_[i] = 0.0;
  }
  return durationS_;
}

void JointMotion::stop() {
  ++orderCount_;
  halt();
}

void JointMotion::halt() {
  durationS_ = 0.0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    paths_[i].active = false;
    velocityDegPerS_[i] = referenceDegPerS_[i] = 0.0;
    if (controller_ != ControllerType::kPose) targetVelocityDegPerS_[i] = 0.0;
    if (power_[i]) states_[i] = AxisState::kIdle;
  }
}

double JointMotion::covered(std::size_t axis, double timeS) const {
  const double distance = std::abs(paths_[axis].distanceDeg);
  if (timeS >= durationS_) return distance;
  if (motionProfile_ == VelocityProfile::kSinSquare) {
    const double phase = timeS / durationS_;
    return distance * (phase - std::sin(2.0 * pi * phase) / (2.0 * pi));
  }
  const double a = paths_[axis].accelerationDegPerS2;
  const double v = cruise(distance, durationS_, a);
  const double rampS = v / a;
  if (timeS < rampS) return a * timeS * timeS / 2.0;
  const double leftS = durationS_ - timeS;
  if (leftS < rampS) return distance - a * leftS * leftS / 2.0;
  return v * (timeS - rampS / 2.0);
}

double JointMotion::speedAt(std::size_t axis, double timeS) const {
  if (timeS >= durationS_) return 0.0;
  const double distance = std::abs(paths_[axis].distanceDeg);
  if (motionProfile_ == VelocityProfile::kSinSquare) {
    const double sine = std::sin(pi * timeS / durationS_);
    return 2.0 * distance / durationS_ * sine * sine;
  }
  const double a = paths_[axis].accelerationDegPerS2;
  return std::min({cruise(distance, durationS_, a), a * timeS, a * (durationS_ - timeS)});
}

double JointMotion::speedFactor(std::size_t axis, double direction) const {
  const double share =
      1.0 - (direction > 0.0 ? resistsClockwise_[axis] : resistsCounterClockwise_[axis]);
  return share < kHeld ? 0.0 : share;
}

void JointMotion::advance(double dtS) {
  if (!(dtS > 0.0)) return;
  if (controller_ == ControllerType::kPose)
    advancePose(dtS);
  else
    advanceVelocity(dtS);
}

void JointMotion::advancePose(double dtS) {
  if (durationS_ <= 0.0) return;
  bool running = false;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    Path& path = paths_[i];
    if (!path.active) continue;
    const double direction = path.distanceDeg > 0.0 ? 1.0 : -1.0;
    const double free = speedFactor(i, direction);
    path.timeS += dtS * free;
    if (path.timeS >= durationS_) {
      angleDeg_[i] = path.startDeg + path.distanceDeg;
      velocityDegPerS_[i] = 0.0;
      path.active = false;
      states_[i] = AxisState::kIdle;
      continue;
    }
    running = true;
    angleDeg_[i] = path.startDeg + direction * covered(i, path.timeS);
    velocityDegPerS_[i] = direction * free * speedAt(i, path.timeS);
    states_[i] = free > 0.0        ? AxisState::kPositioning
                 : direction > 0.0 ? AxisState::kBlockedClockwise
                                   : AxisState::kBlockedCounterClockwise;
  }
  if (!running) durationS_ = 0.0;
}

void JointMotion::advanceVelocity(double dtS) {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (!power_[i]) continue;
    const double before = referenceDegPerS_[i];
    const double wanted = targetVelocityDegPerS_[i];
    double& reference = referenceDegPerS_[i];
    double moved = wanted * dtS;
    if (controller_ == ControllerType::kVelocity) {
      reference = wanted;
    } else {
      const double rampS =
          std::min(dtS, std::abs(wanted - before) / std::max(accelerationDegPerS2_[i], 1e-9));
      const double sign = wanted > before ? 1.0 : -1.0;
      reference = rampS < dtS ? wanted : before + sign * accelerationDegPerS2_[i] * dtS;
      moved = (before + reference) / 2.0 * rampS + reference * (dtS - rampS);
    }
    // A braking axis still moves in its old direction.
    const double direction = moved != 0.0 ? moved : wanted;
    const double free = speedFactor(i, direction);
    if (direction != 0.0 && free == 0.0) {
      velocityDegPerS_[i] = reference = 0.0;
      states_[i] = wanted == 0.0     ? AxisState::kIdle
                   : direction > 0.0 ? AxisState::kBlockedClockwise
                                     : AxisState::kBlockedCounterClockwise;
      continue;
    }
    const double next = angleDeg_[i] + moved * free;
    angleDeg_[i] = std::clamp(next, axes_[i].minimumDeg, axes_[i].maximumDeg);
    if (angleDeg_[i] != next) {
      velocityDegPerS_[i] = reference = 0.0;
      states_[i] = AxisState::kLimitReached;
      continue;
    }
    velocityDegPerS_[i] = reference * free;
    if (reference != 0.0 || wanted != 0.0)
      states_[i] = AxisState::kSpeedMode;
    else if (states_[i] != AxisState::kLimitReached)
      states_[i] = AxisState::kIdle;
  }
}

std::vector<AxisState> JointMotion::states() const { return states_; }

bool JointMotion::moving() const {
  return std::any_of(states_.begin(), states_.end(), [](AxisState state) {
    return state == AxisState::kPositioning || state == AxisState::kSpeedMode;
  });
}

}  // namespace palpate

// Joint motion of the SDH-2's emulated motion controller: seven axes with targets, velocities,
// accelerations, power and states that move in simulated time. It is independent of the protocol.
//
// Velocity profiles of a motion over a distance d within a time T, velocity limit v, acceleration
// limit a:
//   sin-square: v(t) = 2 d/T sin^2(pi t/T); its peak acceleration is 2 pi d/T^2, so
//               T = max(2 d/v, sqrt(2 pi d/a))
//   ramp:       trapezoid; T = d/v + v/a, or 2 sqrt(d/a) where v isn't reached
// All axes take the time of the slowest. Positive is clockwise (closing).
#pragma once

#include <cstdint>
#include <vector>

#include <palpate/model/hand_description.h>

namespace palpate {

enum class AxisState : std::uint8_t {
  kIdle = 0,
  kPositioning = 1,  // target of an `m` motion not yet reached
  kSpeedMode = 2,    // moving under a velocity controller
  kNotInitialised = 3,
  kBlockedClockwise = 4,
  kBlockedCounterClockwise = 5,
  kDisabled = 6,      // power off
  kLimitReached = 7,  // position limit reached and stopped
};

enum class ControllerType : std::uint8_t { kPose = 0, kVelocity = 1, kVelocityAcceleration = 2 };
enum class VelocityProfile : std::uint8_t { kSinSquare = 0, kRamp = 1 };

// Vectors have one entry per axis. Setters throw std::out_of_range (value outside the axis' range)
// or std::invalid_argument (wrong size, not finite); they change nothing then.
class JointMotion {
 public:
  // The axes start at `startDeg`, disabled; pose controller, 40 deg/s, 100 deg/s^2, sin-square.
  JointMotion(const HandDescription& hand, std::vector<double> startDeg);

  void setTargets(const std::vector<double>& deg);
  // Pose controller: 0..limit, used by the next startMotion(). Velocity controllers: -limit..limit,
  // moves at once (kVelocityAcceleration ramps with the accelerations).
  void setVelocities(const std::vector<double>& degPerS);
  void setAccelerations(const std::vector<double>& degPerS2);
  // Switched off, an axis stops where it is with the state kDisabled.
  void setPower(const std::vector<bool>& on);
  // Also sets the velocities: to 40 deg/s (pose) or 0 (velocity controllers).
  void setController(ControllerType type);
  void setProfile(VelocityProfile profile);

  // Command `m`: enables all axes; all start and arrive together. Returns the duration [s]; 0 when
  // all axes are at their targets.
  double startMotion();
  // Command `get_duration`: duration of the motion that startMotion() would begin [s].
  double durationOfPending() const;
  // Command `stop`: the motion ends at the present angles; power stays on.
  void stop();

  void advance(double dtS);
  // Resistance of an axis against clockwise and counter-clockwise motion as a fraction of its
  // torque, 0 (free) .. 1 (held). The speed is reduced by this fraction; at 1 the state is
  // "blocked", and the motion continues when the resistance decreases.
  void setResistance(std::size_t axis, double clockwise, double counterClockwise);
  void setBlocked(std::size_t axis, bool clockwise, bool counterClockwise) {
    setResistance(axis, clockwise ? 1.0 : 0.0, counterClockwise ? 1.0 : 0.0);
  }

  const std::vector<double>& angles() const noexcept { return angleDeg_; }
  const std::vector<double>& velocities() const noexcept { return velocityDegPerS_; }  // actual
  const std::vector<double>& referenceVelocities() const noexcept { return referenceDegPerS_; }
  const std::vector<double>& targets() const noexcept { return targetDeg_; }
  const std::vector<double>& targetVelocities() const noexcept { return targetVelocityDegPerS_; }
  const std::vector<double>& accelerations() const noexcept { return accelerationDegPerS2_; }
  const std::vector<bool>& power() const noexcept { return power_; }
  std::vector<AxisState> states() const;
  ControllerType controller() const noexcept { return controller_; }
  VelocityProfile profile() const noexcept { return profile_; }
  bool moving() const;
  // Number of orders so far: every startMotion(), stop() and setPower(), also those that change
  // nothing, velocities of a velocity controller, and a setController() that ends a motion. A
  // caller that counts its own orders notices those of others.
  std::uint64_t orderCount() const noexcept { return orderCount_; }

 private:
  // Motion of one axis to a target; the velocity profile covers the distance within the duration.
  struct Path {
    double startDeg = 0.0;
    double distanceDeg = 0.0;           // signed
    double accelerationDegPerS2 = 0.0;  // value when the motion began
    // Progress of this axis in time; less than that of the others when resistance slowed it.
    double timeS = 0.0;
    bool active = false;
  };
  void switchPower(const std::vector<bool>& on);
  void halt();
  void require(const char* what,
               const std::vector<double>& values,
               const std::vector<double>& least,
               const std::vector<double>& most) const;
  void requireSize(const char* what, std::size_t size) const;
  // Duration of the motion of this axis alone [s]; 0 when it is at its target or has no velocity.
  double axisDuration(std::size_t axis) const;
  double covered(std::size_t axis, double timeS) const;  // [deg], unsigned
  double speedAt(std::size_t axis, double timeS) const;  // [deg/s], unsigned
  void advancePose(double dtS);
  void advanceVelocity(double dtS);
  double speedFactor(std::size_t axis, double direction) const;  // 1: free, 0: held

  std::vector<AxisDescription> axes_;
  std::vector<double> angleDeg_, velocityDegPerS_, referenceDegPerS_, targetDeg_,
      targetVelocityDegPerS_, accelerationDegPerS2_;
  std::vector<bool> power_;
  std::vector<double> resistsClockwise_, resistsCounterClockwise_;
  std::vector<AxisState> states_;
  std::vector<Path> paths_;
  std::uint64_t orderCount_ = 0;
  double durationS_ = 0.0;  // duration of the running motion; 0 when none runs
  VelocityProfile motionProfile_ = VelocityProfile::kSinSquare;
  ControllerType controller_ = ControllerType::kPose;
  VelocityProfile profile_ = VelocityProfile::kSinSquare;
};

}  // namespace palpate

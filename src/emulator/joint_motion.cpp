// A first, plain motion: constant velocities, all axes start and arrive together.
#include "palpate/emulator/joint_motion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace palpate {
namespace {
void requireSize(std::size_t is, std::size_t wanted) {
  if (is != wanted) throw std::invalid_argument("wrong number of axes");
}
}  // namespace

JointMotion::JointMotion(const HandDescription& hand, std::vector<double> startDeg)
    : axes_(hand.axes), angleDeg_(std::move(startDeg)) {
  requireSize(angleDeg_.size(), axes_.size());
  const std::size_t n = axes_.size();
  velocityDegPerS_ = referenceDegPerS_ = std::vector<double>(n, 0.0);
  targetDeg_ = angleDeg_;
  targetVelocityDegPerS_.assign(n, 40.0);
  accelerationDegPerS2_.assign(n, 100.0);
  power_.assign(n, false);
  goalDeg_ = angleDeg_;
}
void JointMotion::setTargets(const std::vector<double>& deg) {
  requireSize(deg.size(), axes_.size());
  for (std::size_t i = 0; i < deg.size(); ++i)
    if (deg[i] < axes_[i].minimumDeg || deg[i] > axes_[i].maximumDeg)
      throw std::out_of_range("target outside of the axis' range");
  targetDeg_ = deg;
}
void JointMotion::setVelocities(const std::vector<double>& degPerS) {
  requireSize(degPerS.size(), axes_.size());
  const bool pose = controller_ == ControllerType::kPose;
  for (std::size_t i = 0; i < degPerS.size(); ++i)
    if (std::abs(degPerS[i]) > axes_[i].maximumVelocityDegPerS || (pose && degPerS[i] < 0.0))
      throw std::out_of_range("velocity outside of the axis' range");
  targetVelocityDegPerS_ = degPerS;
  if (!pose) velocityDegPerS_ = referenceDegPerS_ = degPerS;
}
void JointMotion::setAccelerations(const std::vector<double>& degPerS2) {
  requireSize(degPerS2.size(), axes_.size());
  for (std::size_t i = 0; i < degPerS2.size(); ++i)
    if (degPerS2[i] < 0.0 || degPerS2[i] > axes_[i].maximumAccelerationDegPerS2)
      throw std::out_of_range("acceleration outside of the axis' range");
  accelerationDegPerS2_ = degPerS2;
}
void JointMotion::setPower(const std::vector<bool>& on) {
  requireSize(on.size(), axes_.size());
  power_ = on;
  for (std::size_t i = 0; i < on.size(); ++i)
    if (!on[i]) velocityDegPerS_[i] = 0.0, goalDeg_[i] = angleDeg_[i];
}
void JointMotion::setController(ControllerType type) {
  controller_ = type;
  targetVelocityDegPerS_.assign(axes_.size(), type == ControllerType::kPose ? 40.0 : 0.0);
}
void JointMotion::setProfile(VelocityProfile profile) { profile_ = profile; }
double JointMotion::durationOfPending() const {
  double durationS = 0.0;
  for (std::size_t i = 0; i < axes_.size(); ++i)
    if (targetVelocityDegPerS_[i] > 0.0)
      durationS =
          std::max(durationS, std::abs(targetDeg_[i] - angleDeg_[i]) / targetVelocityDegPerS_[i]);
  return durationS;
}
double JointMotion::startMotion() {
  const double durationS = durationOfPending();
  power_.assign(axes_.size(), true);
  goalDeg_ = targetDeg_;
  for (std::size_t i = 0; i < axes_.size(); ++i)
    velocityDegPerS_[i] = durationS > 0.0 ? (goalDeg_[i] - angleDeg_[i]) / durationS : 0.0;
  return durationS;
}
void JointMotion::stop() {
  goalDeg_ = angleDeg_;
  velocityDegPerS_.assign(axes_.size(), 0.0);
}
void JointMotion::advance(double dtS) {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double step = velocityDegPerS_[i] * dtS;
    if (controller_ == ControllerType::kPose &&
        std::abs(step) >= std::abs(goalDeg_[i] - angleDeg_[i])) {
      angleDeg_[i] = goalDeg_[i];
      velocityDegPerS_[i] = 0.0;
    } else {
      angleDeg_[i] = std::clamp(angleDeg_[i] + step, axes_[i].minimumDeg, axes_[i].maximumDeg);
    }
  }
}
void JointMotion::setBlocked(std::size_t, bool, bool) {}
std::vector<AxisState> JointMotion::states() const {
  std::vector<AxisState> states;
  for (std::size_t i = 0; i < axes_.size(); ++i)
    states.push_back(!power_[i]                             ? AxisState::kDisabled
                     : velocityDegPerS_[i] == 0.0           ? AxisState::kIdle
                     : controller_ == ControllerType::kPose ? AxisState::kPositioning
                                                            : AxisState::kSpeedMode);
  return states;
}
bool JointMotion::moving() const {
  return std::any_of(
      velocityDegPerS_.begin(), velocityDegPerS_.end(), [](double v) { return v != 0.0; });
}

}  // namespace palpate

#include "palpate/emulator/joint_motion.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"

namespace palpate::joint_motion_test {
namespace {

using Values = std::vector<double>;

JointMotion hand() { return JointMotion(sdh2(), Values(7, 0.0)); }
Values all(double value) { return Values(7, value); }

void run(JointMotion& joints, double seconds, double stepS = 0.001) {
  const auto steps = static_cast<int>(std::lround(seconds / stepS));
  for (int i = 0; i < steps; ++i) joints.advance(stepS);
}

TEST(JointMotion, PowersUpDisabledAsTheControllerDoes) {
  const JointMotion joints = hand();
  EXPECT_EQ(joints.states(), std::vector<AxisState>(7, AxisState::kDisabled));
  EXPECT_EQ(joints.targetVelocities(), all(40.0));
  EXPECT_EQ(joints.accelerations(), all(100.0));
  EXPECT_EQ(joints.controller(), ControllerType::kPose);
  EXPECT_EQ(joints.profile(), VelocityProfile::kSinSquare);
}

// v(t) = 2 d/T sin^2(pi t/T) covers d in T, and half of it in T/2, where the velocity is largest.
TEST(JointMotion, SinSquareFollowsItsClosedForm) {
  JointMotion joints = hand();
  joints.setAccelerations({5000, 400, 1500, 400, 1500, 400, 1500});
  Values target = all(0.0);
  target[2] = 60.0;
  joints.setTargets(target);
  const double duration = joints.startMotion();
  EXPECT_DOUBLE_EQ(duration, 2.0 * 60.0 / 40.0);
  joints.advance(duration / 2.0);
  EXPECT_NEAR(joints.angles()[2], 30.0, 1e-9);
  EXPECT_NEAR(joints.velocities()[2], 40.0, 1e-9);
  joints.advance(duration / 4.0);
  EXPECT_NEAR(joints.angles()[2], 60.0 * (0.75 + 1.0 / (2.0 * std::numbers::pi)), 1e-9);
  EXPECT_NEAR(joints.velocities()[2], 20.0, 1e-9);
  EXPECT_EQ(joints.states()[2], AxisState::kPositioning);
  joints.advance(duration / 4.0);
  EXPECT_EQ(joints.angles()[2], 60.0);
  EXPECT_EQ(joints.states()[2], AxisState::kIdle);
  EXPECT_FALSE(joints.moving());
}

TEST(JointMotion, AccelerationLimitsAShortMotion) {
  JointMotion joints = hand();  // 100 deg/s^2
  Values target = all(0.0);
  target[1] = -2.0;
  joints.setTargets(target);
  const double duration = joints.startMotion();
  EXPECT_NEAR(duration, std::sqrt(2.0 * std::numbers::pi * 2.0 / 100.0), 1e-12);
  // The velocity, measured on the angles, never exceeds the limit.
  double before = 0.0, beforeThat = 0.0, most = 0.0;
  constexpr double kStepS = 1e-3;
  for (double t = 0.0; t < duration; t += kStepS) {
    joints.advance(kStepS);
    const double now = joints.angles()[1];
    if (t > 2 * kStepS)
      most = std::max(most, std::abs(now - 2 * before + beforeThat) / kStepS / kStepS);
    beforeThat = before;
    before = now;
  }
  EXPECT_NEAR(most, 100.0, 1.0);
}

TEST(JointMotion, RampIsATrapezoid) {
  JointMotion joints = hand();
  joints.setProfile(VelocityProfile::kRamp);
  Values target = all(0.0);
  target[3] = 40.0;
  joints.setTargets(target);
  const double duration = joints.startMotion();
  EXPECT_DOUBLE_EQ(duration, 40.0 / 40.0 + 40.0 / 100.0);
  joints.advance(0.4);
  EXPECT_NEAR(joints.angles()[3], 8.0, 1e-9);
  EXPECT_NEAR(joints.velocities()[3], 40.0, 1e-9);
  joints.advance(0.6);
  EXPECT_NEAR(joints.angles()[3], 32.0, 1e-9);
  joints.advance(0.2);
  EXPECT_NEAR(joints.velocities()[3], 20.0, 1e-9);
  joints.advance(0.3);
  EXPECT_EQ(joints.angles()[3], 40.0);
  // The distance is too short to reach 40 deg/s.
  target[3] = 49.0;
  joints.setTargets(target);
  EXPECT_DOUBLE_EQ(joints.startMotion(), 2.0 * std::sqrt(9.0 / 100.0));
}

TEST(JointMotion, AllAxesStartAndArriveTogether) {
  for (const VelocityProfile profile : {VelocityProfile::kSinSquare, VelocityProfile::kRamp}) {
    JointMotion joints = hand();
    joints.setProfile(profile);
    joints.setTargets({60, -30, 20, -5, 90, 45, -80});
    const double duration = joints.startMotion();
    EXPECT_EQ(duration, joints.durationOfPending());
    joints.advance(duration * 0.5);
    for (std::size_t i = 0; i < 7; ++i)
      EXPECT_NEAR(joints.angles()[i], joints.targets()[i] / 2.0, 1e-9) << i;
    joints.advance(duration * 0.499);
    EXPECT_EQ(joints.states(), std::vector<AxisState>(7, AxisState::kPositioning));
    joints.advance(duration * 0.002);
    EXPECT_EQ(joints.angles(), joints.targets());
    EXPECT_EQ(joints.startMotion(), 0.0);
  }
}

TEST(JointMotion, StopEndsWhereItIsAndKeepsPower) {
  JointMotion joints = hand();
  joints.setTargets(all(50.0));
  joints.startMotion();
  run(joints, 0.5);
  const Values there = joints.angles();
  joints.stop();
  run(joints, 0.5);
  EXPECT_EQ(joints.angles(), there);
  EXPECT_EQ(joints.states(), std::vector<AxisState>(7, AxisState::kIdle));
  EXPECT_EQ(joints.power(), std::vector<bool>(7, true));
}

TEST(JointMotion, NewTargetsWaitForTheNextStart) {
  JointMotion joints = hand();
  joints.setTargets(all(10.0));
  const double duration = joints.startMotion();
  joints.advance(duration / 2);
  joints.setTargets(all(80.0));
  joints.advance(duration);
  EXPECT_EQ(joints.angles(), all(10.0));
}

TEST(JointMotion, AnAxisWithoutPowerStaysWhereItIs) {
  JointMotion joints = hand();
  joints.setTargets(all(60.0));
  joints.startMotion();
  run(joints, 0.5);
  std::vector<bool> power(7, true);
  power[4] = false;
  joints.setPower(power);
  const double there = joints.angles()[4];
  run(joints, 5.0);
  EXPECT_EQ(joints.angles()[4], there);
  EXPECT_EQ(joints.states()[4], AxisState::kDisabled);
  EXPECT_EQ(joints.angles()[3], 60.0);
}

TEST(JointMotion, VelocityControllersMoveAtOnceAndStopAtTheLimit) {
  JointMotion joints = hand();
  joints.setController(ControllerType::kVelocity);
  EXPECT_EQ(joints.targetVelocities(), all(0.0));
  joints.setPower(std::vector<bool>(7, true));
  Values v = all(0.0);
  v[2] = -50.0;
  joints.setVelocities(v);
  run(joints, 1.0);
  EXPECT_NEAR(joints.angles()[2], -50.0, 1e-9);
  EXPECT_EQ(joints.states()[2], AxisState::kSpeedMode);
  EXPECT_EQ(joints.states()[1], AxisState::kIdle);
  run(joints, 1.0);
  EXPECT_EQ(joints.angles()[2], -90.0);
  EXPECT_EQ(joints.states()[2], AxisState::kLimitReached);
  joints.setVelocities(all(0.0));
  run(joints, 0.1);
  EXPECT_EQ(joints.velocities(), all(0.0));
}

TEST(JointMotion, TheSecondVelocityControllerRamps) {
  JointMotion joints = hand();
  joints.setController(ControllerType::kVelocityAcceleration);
  joints.setPower(std::vector<bool>(7, true));
  Values v = all(0.0);
  v[6] = 50.0;
  joints.setVelocities(v);  // 100 deg/s^2: half a second, 12.5 deg
  run(joints, 0.25);
  EXPECT_NEAR(joints.referenceVelocities()[6], 25.0, 1e-9);
  run(joints, 0.25);
  EXPECT_NEAR(joints.angles()[6], 12.5, 1e-9);
  run(joints, 0.5);
  EXPECT_NEAR(joints.angles()[6], 37.5, 1e-9);
}

TEST(JointMotion, AnAxisThatMeetsSomethingIsBlocked) {
  JointMotion joints = hand();
  joints.setTargets(all(60.0));
  joints.startMotion();
  run(joints, 1.0);
  joints.setBlocked(1, true, false);
  const double there = joints.angles()[1];
  run(joints, 5.0);
  EXPECT_EQ(joints.angles()[1], there);
  EXPECT_EQ(joints.states()[1], AxisState::kBlockedClockwise);
  EXPECT_EQ(joints.angles()[2], 60.0);
  joints.setTargets(all(-10.0 + 10.0));
  joints.startMotion();
  run(joints, 8.0);
  EXPECT_EQ(joints.angles()[1], 0.0) << "back it may";
}

TEST(JointMotion, AnAxisThatIsSlowedDownArrivesLaterAndOneThatIsLetGoGoesOn) {
  JointMotion joints = hand();
  joints.setTargets(all(60.0));
  const double duration = joints.startMotion();
  joints.setResistance(1, 0.5, 0.0);
  joints.setBlocked(2, true, false);
  run(joints, duration / 2);
  EXPECT_NEAR(joints.angles()[3], 30.0, 0.05);
  EXPECT_NEAR(joints.angles()[1], 60.0 * (0.25 - 1.0 / (2.0 * std::numbers::pi)), 0.05);
  EXPECT_EQ(joints.angles()[2], 0.0);
  EXPECT_EQ(joints.states()[2], AxisState::kBlockedClockwise);
  run(joints, duration);
  EXPECT_EQ(joints.angles()[3], 60.0);
  joints.setBlocked(2, false, false);
  run(joints, duration + 0.1);
  EXPECT_EQ(joints.angles(), all(60.0));
}

// An acceleration set during a motion takes effect with the next motion, so nothing jumps.
TEST(JointMotion, NewAccelerationsWaitForTheNextStart) {
  JointMotion joints = hand();
  joints.setProfile(VelocityProfile::kRamp);
  Values target = all(0.0);
  target[3] = 40.0;
  joints.setTargets(target);
  joints.startMotion();
  joints.advance(0.3);
  EXPECT_NEAR(joints.angles()[3], 4.5, 1e-9);
  joints.setAccelerations(all(400.0));
  joints.advance(0.1);
  EXPECT_NEAR(joints.angles()[3], 8.0, 1e-9);
  joints.advance(1.0);
  EXPECT_EQ(joints.angles()[3], 40.0);
}

TEST(JointMotion, VelocityControllersAreBlockedAndSlowedDownLikeMotions) {
  for (const ControllerType type :
       {ControllerType::kVelocity, ControllerType::kVelocityAcceleration}) {
    JointMotion joints = hand();
    joints.setController(type);
    joints.setPower(std::vector<bool>(7, true));
    joints.setVelocities({0, 20, -20, 20, 0, 0, 0});
    run(joints, 1.0);  // both at full velocity
    joints.setBlocked(1, true, false);
    joints.setBlocked(2, false, true);
    joints.setResistance(3, 0.25, 0.0);
    const Values before = joints.angles();
    run(joints, 1.0);
    EXPECT_EQ(joints.angles()[1], before[1]);
    EXPECT_EQ(joints.angles()[2], before[2]);
    EXPECT_NEAR(joints.angles()[3], before[3] + 15.0, 1e-9);
    EXPECT_NEAR(joints.velocities()[3], 15.0, 1e-9) << "the actual one";
    EXPECT_NEAR(joints.referenceVelocities()[3], 20.0, 1e-9);
    EXPECT_EQ(joints.states()[1], AxisState::kBlockedClockwise);
    EXPECT_EQ(joints.states()[2], AxisState::kBlockedCounterClockwise);
    EXPECT_EQ(joints.velocities()[1], 0.0);
    joints.setVelocities({0, -20, 0, 0, 0, 0, 0});
    run(joints, 1.0);
    EXPECT_LT(joints.angles()[1], before[1] - 15.0) << "back it may";
    EXPECT_EQ(joints.states()[2], AxisState::kIdle) << "pushes no more";
  }
}

// While an axis still brakes it moves in its old direction, and can be blocked there.
TEST(JointMotion, ABrakingAxisDoesNotPassThroughWhatBlocksIt) {
  JointMotion joints = hand();
  joints.setController(ControllerType::kVelocityAcceleration);
  joints.setPower(std::vector<bool>(7, true));
  joints.setVelocities({0, 40, 0, 0, 0, 0, 0});
  run(joints, 0.5);
  joints.setVelocities({0, -40, 0, 0, 0, 0, 0});
  joints.setBlocked(1, true, false);
  const double there = joints.angles()[1];
  for (int i = 0; i < 300; ++i) {
    joints.advance(0.001);
    ASSERT_LE(joints.angles()[1], there);
  }
  EXPECT_LT(joints.angles()[1], there) << "it turned round at once";
}

TEST(JointMotion, WrongValuesChangeNothing) {
  JointMotion joints = hand();
  EXPECT_THROW(joints.setTargets(all(-1.0)), std::out_of_range) << "axis 0 begins at 0";
  EXPECT_THROW(joints.setTargets(all(90.5)), std::out_of_range);
  EXPECT_THROW(joints.setTargets(Values(6, 0.0)), std::invalid_argument);
  EXPECT_THROW(joints.setTargets(all(std::numeric_limits<double>::quiet_NaN())),
               std::invalid_argument);
  EXPECT_EQ(joints.targets(), all(0.0));
  EXPECT_THROW(joints.setVelocities(all(-1.0)), std::out_of_range) << "pose controller";
  EXPECT_THROW(joints.setVelocities(all(100.0)), std::out_of_range) << "axis 0 allows 83";
  EXPECT_THROW(joints.setAccelerations(all(401.0)), std::out_of_range);
  EXPECT_THROW(joints.setPower(std::vector<bool>(3)), std::invalid_argument);
  EXPECT_THROW(JointMotion(sdh2(), all(-5.0)), std::out_of_range);
}

TEST(JointMotion, CountsEachOrderAlsoOneThatChangesNothing) {
  JointMotion joints = hand();
  std::uint64_t count = joints.orderCount();
  const auto orders = [&](const char* what, const std::function<void()>& order) {
    order();
    EXPECT_EQ(joints.orderCount(), ++count) << what;
  };
  orders("a stop at rest", [&] { joints.stop(); });
  orders("power on", [&] { joints.setPower(std::vector<bool>(7, true)); });
  orders("power that is on already", [&] { joints.setPower(std::vector<bool>(7, true)); });
  orders("a motion to where it is", [&] { joints.startMotion(); });
  joints.setTargets(all(5.0));
  joints.setVelocities(all(20.0));
  joints.setController(ControllerType::kPose);
  EXPECT_EQ(joints.orderCount(), count) << "values alone move nothing";
  orders("a motion", [&] { joints.startMotion(); });
  run(joints, 0.1);
  orders("a stop in a motion", [&] { joints.stop(); });
  joints.startMotion();
  ++count;
  orders("a controller that ends a motion",
         [&] { joints.setController(ControllerType::kVelocity); });
  orders("a velocity", [&] { joints.setVelocities(all(5.0)); });
  EXPECT_THROW(joints.setPower({true}), std::invalid_argument);
  EXPECT_EQ(joints.orderCount(), count) << "refused";
}

}  // namespace
}  // namespace palpate::joint_motion_test

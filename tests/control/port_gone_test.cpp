// Tests how the hand continues to move when its motion port disappears, and for how long.
#include <limits>

#include "control/machine_bench.h"
#include "control/scripted_hand.h"
#include "testing/testing.h"

namespace palpate::port_gone_test {
namespace {
using testing::GraspBench;
using testing::kHeld;
using testing::kIdle;
using testing::kPeriodUs;
using testing::reactive;
using Bench = testing::MachineBench;

// Time by which a motion may exceed the announced one, or the one by velocity alone.
constexpr double kStartAndStopS = 0.5;

GraspRequest slipAware() {
  GraspRequest request = reactive(200);
  request.mode = GraspMode::kSlip;
  return request;
}

GraspReport gone(Bench& bench) {
  bench.machine.onMotionPortGone("unplugged", bench.us);
  EXPECT_FALSE(bench.machine.active());
  return bench.machine.takeReport().value();
}

// Closes on an object that touches finger 0 distal, and holds it.
void hold(Bench& bench, GraspRequest request) {
  bench.begin(request);
  bench.take();
  bench.frames(1, 250.0F);
  EXPECT_TRUE(bench.takeStop());
  bench.machine.onStopAcknowledged(bench.us);
  for (int i = 0; i < 20; ++i) {
    bench.frames(1, 250.0F);
    bench.machine.onTime(bench.us);
  }
  ASSERT_EQ(bench.machine.phase(), GraspPhase::kHolding);
}

TEST(PortGone, ClosingGoesOnForAsLongAsWasAnnounced) {
  Bench bench;
  bench.begin(reactive());
  bench.take(4.0);
  bench.us += 1'500'000;
  const GraspReport report = gone(bench);
  EXPECT_EQ(report.outcome, GraspOutcome::kPortGone);
  EXPECT_EQ(report.text,
            "the motion port is gone: unplugged; the hand finishes its motion by itself");
  EXPECT_NEAR(report.remainingMotionS.value(), 2.5 + kStartAndStopS, 1e-6);
}

TEST(PortGone, WhatWasAnnouncedIsOverAtItsEnd) {
  Bench bench;
  bench.begin({});
  bench.take(1.0);
  bench.us += 6'000'000;
  EXPECT_EQ(gone(bench).remainingMotionS, 0.0);
}

// At 10 deg/s. While moving to the start, the start is the target, not the close ratio.
TEST(PortGone, PreshapingGoesOnToItsStartByVelocityAndAnglesWhereNothingWasAnnounced) {
  for (const bool answered : {false, true}) {
    Bench bench;
    GraspRequest request = reactive();
    request.startRatio = 0.0;  // centrical: 60, -75, 75, -75, 75, -75, 75 deg
    bench.machine.onAngles({60.0, -45.0, 75.0, -75.0, 65.0, -75.0, 75.0}, 0);
    bench.begin(request);
    if (answered)
      bench.take(std::numeric_limits<double>::quiet_NaN());
    else
      bench.machine.takeCommand();
    EXPECT_NEAR(gone(bench).remainingMotionS.value(), 3.0 + kStartAndStopS, 1e-9) << answered;
  }
}

// Its farthest axis moves from 90 to -75 deg, or from -90 to 75 deg.
TEST(PortGone, WithoutAnglesItMayComeFromAnywhere) {
  Bench bench;
  GraspRequest request = reactive();
  request.startRatio = 0.0;
  bench.begin(request);
  bench.machine.takeCommand();
  EXPECT_NEAR(gone(bench).remainingMotionS.value(), 16.5 + kStartAndStopS, 1e-9);
}

TEST(PortGone, LooseningGoesOnAtItsOwnVelocity) {
  Bench bench;
  GraspRequest request = slipAware();
  request.holding.noSlipS = 1.0;
  request.holding.weightN = 1.0;
  hold(bench, request);
  for (int i = 0; i < 100 && bench.machine.phase() == GraspPhase::kHolding; ++i) {
    bench.frames(1, 250.0F);
    bench.machine.onTime(bench.us);
  }
  ASSERT_EQ(bench.machine.phase(), GraspPhase::kLoosening);
  // To the open hand at 1 deg/s, although 10 deg/s were requested for the grasp.
  bench.machine.onAngles({60.0, -63.0, 75.0, -75.0, 65.0, -75.0, 75.0}, 0);
  const GraspReport report = gone(bench);
  EXPECT_NEAR(report.remainingMotionS.value(), 12.0 + kStartAndStopS, 1e-9);
}

TEST(PortGone, AHandThatHoldsStandsStill) {
  Bench bench;
  hold(bench, slipAware());
  const GraspReport report = gone(bench);
  EXPECT_EQ(report.outcome, GraspOutcome::kPortGone);
  EXPECT_EQ(report.text,
            "the motion port is gone: unplugged; the hand holds, without slip detection");
  EXPECT_EQ(report.remainingMotionS, 0.0);
}

TEST(PortGone, AStopThatWasNotTakenLeavesTheMotionToItself) {
  Bench bench;
  bench.begin({});
  bench.take(4.0);
  bench.machine.stop(bench.us);
  const GraspReport report = gone(bench);
  EXPECT_EQ(report.text,
            "stopped by the user, but the motion port is gone: unplugged; the hand finishes its "
            "motion by itself");
  EXPECT_NEAR(report.remainingMotionS.value(), 4.0 + kStartAndStopS, 1e-6);
}

TEST(PortGone, AStopWhileItHoldsLeavesItHolding) {
  Bench bench;
  hold(bench, slipAware());
  bench.machine.stop(bench.us);
  const GraspReport report = gone(bench);
  EXPECT_EQ(
      report.text,
      "stopped by the user: the hand holds, without slip detection, and the motion port is gone: "
      "unplugged");
  EXPECT_EQ(report.remainingMotionS, 0.0);
}

TEST(PortGone, AnEndOfAnotherKindSaysNothingOfIt) {
  Bench bench;
  bench.begin({});
  bench.take();
  bench.us += 3'000'000;
  bench.machine.onAxisStates(kIdle, bench.us);
  EXPECT_FALSE(bench.machine.takeReport()->remainingMotionS.has_value());
}

// A later refusal is the last report, but does not describe what the hand does.
TEST(PortGone, IsRememberedUntilThePortIsBackWhateverIsRefusedMeanwhile) {
  GraspBench bench;
  bench.hand->durationS = 4.0;
  bench.control->grasp({});
  bench.hand->states.assign(7, 1);
  bench.feel(1);
  EXPECT_FALSE(bench.control->status().portGone.has_value());
  bench.hand->state.motion->state = PortState::kLost;
  bench.hand->state.motion->unplugged = true;
  bench.wait(5000);
  EXPECT_THROW(bench.control->grasp({}), DeviceError);
  GraspStatus status = bench.control->status();
  EXPECT_EQ(status.last->outcome, GraspOutcome::kRefused);
  ASSERT_TRUE(status.portGone.has_value());
  EXPECT_EQ(status.portGone->outcome, GraspOutcome::kPortGone);
  EXPECT_GT(status.portGone->remainingMotionS.value(), 4.0);
  bench.hand->state.motion->state = PortState::kStreaming;
  bench.wait(5000);
  EXPECT_FALSE(bench.control->status().portGone.has_value());
  bench.hand->state.motion->state = PortState::kLost;
  bench.hand->state.motion->unplugged = true;  // while nothing moved
  bench.wait(5000);
  EXPECT_FALSE(bench.control->status().portGone.has_value());
}

TEST(PortGone, TheControlKnowsTheAngles) {
  GraspBench bench;
  bench.hand->answers = false;
  GraspRequest request;
  request.closeRatio = 0.0;
  bench.hand->sink->onSample({bench.clock.hostUs(), {60.0, -70.0, 75.0, -75.0, 65.0, -75.0, 75.0}});
  bench.wait(5000);
  bench.control->grasp(request);
  bench.hand->state.motion->state = PortState::kLost;
  bench.hand->state.motion->unplugged = true;
  bench.wait(5000);
  EXPECT_NEAR(
      bench.control->status().portGone->remainingMotionS.value(), 1.0 + kStartAndStopS, 1e-9);
}

}  // namespace
}  // namespace palpate::port_gone_test

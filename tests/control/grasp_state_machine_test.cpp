#include "palpate/control/grasp_state_machine.h"

#include <limits>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/preshape.h"

#include "control/machine_bench.h"
#include "testing/testing.h"

namespace palpate::grasp_state_machine_test {
namespace {

using testing::kHeld;
using testing::kIdle;
using testing::kMoving;
using testing::kPeriodUs;
using testing::reactive;
using Bench = testing::MachineBench;

TEST(GraspStateMachine, MovesNothingUnasked) {
  Bench bench;
  bench.frames(100, 3000.0F);
  bench.machine.onTime(bench.us + 10'000'000);
  bench.machine.onAxisStates(kMoving, bench.us);
  EXPECT_FALSE(bench.machine.takeCommand().has_value());
  EXPECT_FALSE(bench.machine.active());
}

TEST(GraspStateMachine, EveryPhaseHasItsNameAndMayEnd) {
  const std::vector<std::string_view> names = {
      "idle", "preshaping", "closing", "stopping", "settling", "easing", "holding", "loosening"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto phase = static_cast<GraspPhase>(i);
    EXPECT_EQ(nameOf(phase), names[i]);
    EXPECT_EQ(mayFollow(phase, GraspPhase::kIdle), i != 0) << names[i];
    EXPECT_EQ(mayFollow(phase, GraspPhase::kStopping), i != 0) << names[i];
  }
  EXPECT_FALSE(mayFollow(GraspPhase::kIdle, GraspPhase::kHolding));
  EXPECT_FALSE(mayFollow(GraspPhase::kPreshaping, GraspPhase::kSettling));
  EXPECT_FALSE(mayFollow(GraspPhase::kHolding, GraspPhase::kEasing));
}

TEST(GraspStateMachine, PlainGraspGoesToItsTargetAndEnds) {
  Bench bench;
  bench.begin({});
  EXPECT_EQ(bench.machine.phase(), GraspPhase::kClosing);
  EXPECT_FALSE(bench.machine.underTactileControl());
  EXPECT_EQ(bench.take().targetDeg, sdh2Preshape("centrical").anglesDeg(0.5));
  bench.us += 1'000'000;
  bench.machine.onAxisStates(kMoving, bench.us);
  EXPECT_TRUE(bench.machine.active());
  bench.us += 1'000'001;
  bench.machine.onAxisStates(kIdle, bench.us);
  EXPECT_FALSE(bench.machine.active());
  const auto report = bench.machine.takeReport();
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->outcome, GraspOutcome::kFinished);
  EXPECT_TRUE(report->heldAxes.empty());
  EXPECT_FALSE(bench.machine.takeCommand().has_value());
  EXPECT_FALSE(bench.machine.takeReport().has_value());
}

TEST(GraspStateMachine, AGraspThatTouchesNothingSaysSo) {
  const auto textAfter = [](double closeRatio, float counts, std::int64_t silenceUs) {
    Bench bench;
    GraspRequest request;
    request.closeRatio = closeRatio;
    bench.begin(request);
    bench.take(0.0);
    bench.frames(20, counts);
    bench.us += silenceUs;
    bench.machine.onAxisStates(kIdle, bench.us);
    const auto report = bench.machine.takeReport();
    return report ? report->text : std::string("no report");
  };
  EXPECT_EQ(textAfter(0.5, 0.0F, 0), "finished: at its target, touching nothing");
  EXPECT_EQ(textAfter(0.5, 300.0F, 0), "finished: at its target");
  EXPECT_EQ(textAfter(0.0, 0.0F, 0), "finished: at its target");
  // What it touches is not known.
  EXPECT_EQ(textAfter(0.5, 0.0F, 10'000'000), "finished: at its target");
}

TEST(GraspStateMachine, PlainGraspDoesNotMindTheTaxels) {
  Bench bench;
  bench.begin({});
  bench.take();
  bench.frames(5, 3560.0F);
  bench.us += 500'000;  // no silence either
  bench.machine.onTime(bench.us);
  bench.machine.onTactilePortGone("unplugged", bench.us);
  EXPECT_EQ(bench.machine.phase(), GraspPhase::kClosing);
}

TEST(GraspStateMachine, OldFirmwareThatSaysIdleTooEarlyIsNotBelieved) {
  Bench bench;
  bench.begin({});
  bench.take(2.0);
  bench.us += 1'900'000;
  bench.machine.onAxisStates(kIdle, bench.us);
  EXPECT_TRUE(bench.machine.active());
  bench.us += 100'000;
  bench.machine.onAxisStates(kIdle, bench.us);
  EXPECT_FALSE(bench.machine.active());
}

TEST(GraspStateMachine, StatesFromBeforeTheAnswerDoNotCount) {
  Bench bench;
  bench.begin({});
  ASSERT_TRUE(bench.machine.takeCommand().has_value());
  bench.machine.onAxisStates(kHeld, bench.us);
  EXPECT_TRUE(bench.machine.active());
}

TEST(GraspStateMachine, GoesToTheStartFirst) {
  Bench bench;
  GraspRequest request = reactive();
  request.startRatio = 0.0;
  bench.begin(request);
  EXPECT_EQ(bench.machine.phase(), GraspPhase::kPreshaping);
  EXPECT_EQ(bench.take(0.1).targetDeg, sdh2Preshape("centrical").anglesDeg(0.0));
  bench.frames(5);
  bench.machine.onAxisStates(kIdle, bench.us);
  EXPECT_EQ(bench.machine.phase(), GraspPhase::kClosing);
  const MoveJoints closing = bench.take(0.1);
  EXPECT_EQ(closing.targetDeg, sdh2Preshape("centrical").anglesDeg(1.0));
  EXPECT_TRUE(closing.ramp);
}

TEST(GraspStateMachine, ReactiveGraspStopsAtTheFirstTaxelOverTheLimit) {
  for (std::size_t matrix = 0; matrix < 6; ++matrix) {
    Bench bench;
    bench.begin(reactive(200));
    bench.take();
    bench.us += kPeriodUs;
    bench.frame(200.0F, matrix);  // a reading at the limit is not over it
    EXPECT_EQ(bench.machine.phase(), GraspPhase::kClosing);
    bench.us += kPeriodUs;
    bench.frame(201.0F, matrix, 7, 4);
    EXPECT_EQ(bench.machine.phase(), GraspPhase::kStopping);
    EXPECT_TRUE(bench.takeStop());
    bench.machine.onStopAcknowledged(bench.us);
    bench.lookOn();
    const auto report = bench.machine.takeReport();
    ASSERT_TRUE(report.has_value());
    EXPECT_EQ(report->outcome, GraspOutcome::kLimitReached);
    EXPECT_EQ(report->peak.matrix, matrix);
    EXPECT_EQ(report->peak.row, 7);
    EXPECT_EQ(report->peak.column, 4);
    EXPECT_EQ(report->peak.counts, 201.0F);
  }
}

TEST(GraspStateMachine, ItStopsWhileGoingToTheStart) {
  Bench bench;
  GraspRequest request = reactive(50);
  request.startRatio = 0.5;
  bench.begin(request);
  bench.take();
  bench.frames(1, 60.0F);
  EXPECT_TRUE(bench.takeStop());
}

TEST(GraspStateMachine, ItStopsBeforeTheHandHasAnsweredTheMotion) {
  Bench bench;
  bench.begin(reactive(50));
  ASSERT_TRUE(bench.machine.takeCommand().has_value());
  bench.frames(1, 60.0F);
  EXPECT_TRUE(bench.takeStop());
  bench.machine.onMoveAcknowledged(3.0, bench.us);  // late
  EXPECT_EQ(bench.machine.phase(), GraspPhase::kStopping);
}

TEST(GraspStateMachine, AMotionThatWasNotSentYetIsNotSentAfterTheStop) {
  Bench bench;
  bench.begin(reactive(50));
  bench.machine.stop(bench.us);
  EXPECT_TRUE(bench.takeStop());
  EXPECT_FALSE(bench.machine.takeCommand().has_value());
}

TEST(GraspStateMachine, RefusesWhenOverTheLimitAlready) {
  Bench bench;
  bench.frames(1, 333.0F);
  try {
    bench.begin(reactive(200));
    FAIL();
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.fault(), DeviceFault::kRefused);
    EXPECT_NE(std::string(error.what()).find("finger 0 distal, x 2, y 3: 333 counts"),
              std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(bench.machine.takeCommand().has_value());
  EXPECT_NO_THROW(bench.begin({}));  // a plain grasp is allowed
}

TEST(GraspStateMachine, RefusesAReactiveGraspWithoutALivingStream) {
  Bench bench;
  bench.us += 100'001;
  EXPECT_THROW(bench.begin(reactive()), DeviceError);
  EXPECT_FALSE(bench.machine.takeCommand().has_value());
  GraspStateMachine deaf(sdh2());
  EXPECT_THROW(deaf.begin(reactive(), 0, 0), DeviceError);
  EXPECT_NO_THROW(deaf.begin({}, 0, 0));
}

TEST(GraspStateMachine, RefusesASecondGrasp) {
  Bench bench;
  bench.begin({});
  bench.take();
  EXPECT_THROW(bench.begin(reactive()), DeviceError);
  EXPECT_EQ(bench.machine.running().request.mode, GraspMode::kPlain);
  EXPECT_FALSE(bench.machine.takeCommand().has_value());
}

TEST(GraspStateMachine, RefusesValuesOutOfRange) {
  Bench bench;
  GraspRequest request;
  request.closeRatio = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(bench.begin(request), std::invalid_argument);
  EXPECT_FALSE(bench.machine.takeCommand().has_value());
  EXPECT_FALSE(bench.machine.active());
}

TEST(GraspStateMachine, ADeadStreamStopsAReactiveGrasp) {
  Bench bench;
  bench.begin(reactive());
  bench.take();
  EXPECT_EQ(bench.machine.nextUs(), bench.us + 100'001);
  bench.us += 100'000;
  bench.machine.onTime(bench.us);
  EXPECT_EQ(bench.machine.phase(), GraspPhase::kClosing);
  bench.us += 1;
  bench.machine.onTime(bench.us);
  EXPECT_TRUE(bench.takeStop());
  bench.machine.onStopAcknowledged(bench.us);
  EXPECT_EQ(bench.machine.takeReport()->outcome, GraspOutcome::kStreamLost);
}

TEST(GraspStateMachine, AGoneTactilePortStopsAReactiveGraspAtOnce) {
  Bench bench;
  bench.begin(reactive());
  bench.take();
  bench.machine.onTactilePortGone("unplugged", bench.us);
  EXPECT_TRUE(bench.takeStop());
}

TEST(GraspStateMachine, FramesThatCameTooLateStopItAsWell) {
  Bench bench;
  bench.begin(reactive());
  bench.take();
  bench.us += 250'000;
  bench.frame();
  EXPECT_TRUE(bench.takeStop());
}

TEST(GraspStateMachine, TheUserStopsAtAnyMoment) {
  Bench bench;
  bench.begin({});
  bench.take();
  bench.machine.stop(bench.us);
  EXPECT_TRUE(bench.takeStop());
  bench.machine.onStopAcknowledged(bench.us);
  EXPECT_EQ(bench.machine.takeReport()->outcome, GraspOutcome::kStopped);
  bench.machine.stop(bench.us);  // nothing runs: nothing is reported
  EXPECT_FALSE(bench.machine.active());
}

TEST(GraspStateMachine, AStopThatIsNotAnsweredIsSentAgain) {
  Bench bench;
  bench.begin({});
  bench.take();
  bench.machine.stop(bench.us);
  int stops = 0;
  const std::int64_t fromUs = bench.us;
  while (bench.machine.active()) {
    if (bench.takeStop()) ++stops;
    bench.us += 10'000;
    bench.machine.onTime(bench.us);
  }
  // The 2 s that were announced, half a second, and 10 s; every 250 ms.
  EXPECT_EQ(bench.us - fromUs, 12'500'000);
  EXPECT_EQ(stops, 50);
  const auto report = bench.machine.takeReport();
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->outcome, GraspOutcome::kFailed);
  EXPECT_TRUE(report->stateUnknown);
  EXPECT_NE(report->text.find("state unknown: use the power switch"), std::string::npos);
}

TEST(GraspStateMachine, AHandThatRefusesIsStopped) {
  Bench bench;
  bench.begin({});
  bench.machine.takeCommand();
  bench.machine.onCommandFailed("E29 over-temperature", true, bench.us);
  EXPECT_TRUE(bench.takeStop());
  bench.machine.onCommandFailed("no answer", true, bench.us);  // the stop: goes out again later
  EXPECT_TRUE(bench.machine.active());
  bench.machine.onStopAcknowledged(bench.us);
  const auto report = bench.machine.takeReport();
  EXPECT_EQ(report->outcome, GraspOutcome::kFailed);
  EXPECT_NE(report->text.find("E29"), std::string::npos);
}

TEST(GraspStateMachine, WhatWasNeverSentNeedsNoStop) {
  Bench bench;
  bench.begin({});
  bench.machine.takeCommand();
  bench.machine.onCommandFailed("a recording takes no command", false, bench.us);
  EXPECT_FALSE(bench.machine.active());
  EXPECT_FALSE(bench.machine.takeCommand().has_value());
  EXPECT_EQ(bench.machine.takeReport()->outcome, GraspOutcome::kRefused);
}

TEST(GraspStateMachine, AGoneMotionPortEndsIt) {
  Bench bench;
  bench.begin(reactive());
  bench.take();
  bench.machine.onMotionPortGone("unplugged", bench.us);
  EXPECT_FALSE(bench.machine.active());
  EXPECT_FALSE(bench.machine.takeCommand().has_value());
  EXPECT_EQ(bench.machine.takeReport()->outcome, GraspOutcome::kPortGone);
}

TEST(GraspStateMachine, HeldFingersEndAPlainGraspAndGoOnHolding) {
  Bench bench;
  bench.begin({});
  bench.take(5.0);
  bench.machine.onAxisStates(kHeld, bench.us);
  const auto report = bench.machine.takeReport();
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->outcome, GraspOutcome::kFinished);
  EXPECT_EQ(report->heldAxes, (std::vector<int>{1, 5}));
  EXPECT_FALSE(bench.machine.takeCommand().has_value());
}

// The taxels are not monitored after a grasp has ended.
TEST(GraspStateMachine, HeldFingersOfAReactiveGraspDoNotGoOnPushing) {
  Bench bench;
  bench.begin(reactive());
  bench.take(5.0);
  bench.machine.onAxisStates(kHeld, bench.us);
  EXPECT_TRUE(bench.takeStop());
  bench.machine.onStopAcknowledged(bench.us);
  EXPECT_EQ(bench.machine.takeReport()->outcome, GraspOutcome::kFinished);
}

TEST(GraspStateMachine, AMotionThatNeverEndsIsStopped) {
  Bench bench;
  bench.begin({});
  bench.take(2.0);
  bench.machine.onAxisStates(kMoving, bench.us);
  bench.us += 11'000'000;  // 3 * 2 s + 5 s
  bench.machine.onTime(bench.us);
  EXPECT_TRUE(bench.machine.active());
  bench.us += 1;
  bench.machine.onTime(bench.us);
  EXPECT_TRUE(bench.takeStop());
}

TEST(GraspStateMachine, AnAnnouncedDurationThatIsNoNumberIsNone) {
  Bench bench;
  bench.begin({});
  bench.take(std::numeric_limits<double>::quiet_NaN());
  bench.us += 5'000'001;
  bench.machine.onTime(bench.us);
  EXPECT_TRUE(bench.takeStop());
}

TEST(GraspStateMachine, RelaxEndsWhateverRuns) {
  Bench bench;
  bench.begin(reactive());
  bench.take();
  EXPECT_TRUE(bench.machine.underTactileControl());
  bench.machine.relax();
  EXPECT_FALSE(bench.machine.underTactileControl());
  EXPECT_EQ(bench.machine.takeReport()->outcome, GraspOutcome::kRelaxed);
}

}  // namespace
}  // namespace palpate::grasp_state_machine_test

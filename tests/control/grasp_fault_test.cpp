// C-A2: exceptions while fingers move. The process continues, a stop is sent, and the failure is
// reported.
#include <chrono>
#include <new>
#include <stdexcept>
#include <thread>

#include "palpate/core/error.h"

#include "control/scripted_hand.h"
#include "testing/testing.h"

namespace palpate::grasp_fault_test {
namespace {
using testing::GraspBench;

GraspRequest slipAware() {
  GraspRequest request;
  request.mode = GraspMode::kSlip;
  request.closeRatio = 1.0;
  request.limitCounts = 400;
  return request;
}

bool alarmSays(CaptureSession& session, const std::string& word) {
  for (const Event& event : session.takeEvents())
    if (event.kind == "alarm" && event.text.find(word) != std::string::npos) return true;
  return false;
}

// A sensor with other matrices than before: another controller, or other settings.
SensorLayout otherLayout() {
  return SensorLayout({MatrixLayout::full(10, 8, 3.4), MatrixLayout::full(5, 5, 3.4)});
}

void feelOther(GraspBench& bench, float counts) {
  bench.clock.pass(30'000);
  TactileFrame frame(std::make_shared<const SensorLayout>(otherLayout()));
  frame.hostUs = bench.clock.hostUs();
  frame.matrix(1)(2, 2) = counts;
  bench.hand->sink->onFrame(std::move(frame));
  bench.control->step();
}

TEST(GraspFault, AStopIsOnTheWireAndTheControlGoesOn) {
  for (const bool outOfMemory : {false, true}) {
    GraspBench bench;
    bench.control->grasp({});
    bench.hand->states.assign(7, 1);
    bench.hand->fails = [outOfMemory] {
      if (outOfMemory) throw std::bad_alloc();
      throw std::runtime_error("a bug behind the axes");
    };
    bench.control->run();
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    const auto ended = [&] {
      const GraspStatus status = bench.control->status();
      return status.phase == GraspPhase::kIdle && status.last;
    };
    while (!ended() && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    bench.control->stop();  // the control's own thread must not run during the checks
    ASSERT_TRUE(ended());
    EXPECT_EQ(bench.control->status().last->outcome, GraspOutcome::kFailed);
    EXPECT_GE(bench.hand->count<StopMotion>(), 1u);
    EXPECT_TRUE(alarmSays(*bench.session, outOfMemory ? "bad_alloc" : "a bug behind the axes"));
  }
}

TEST(GraspFault, EndsTheGraspAlsoWhereItIsThrownInEveryRound) {
  GraspBench bench;
  bench.hand->answers = false;
  bench.control->grasp({});
  bench.hand->waiting[0].set_value({.durationS = 1.0});
  bench.hand->fails = [] { throw std::runtime_error("again and again"); };
  EXPECT_NO_THROW(bench.wait(5000));
  ASSERT_EQ(bench.hand->count<StopMotion>(), 1u);
  EXPECT_NO_THROW(bench.wait(260'000));  // not answered: sent again
  EXPECT_EQ(bench.hand->count<StopMotion>(), 2u);
  bench.hand->waiting[2].set_value({});
  EXPECT_NO_THROW(bench.wait(5000));
  EXPECT_EQ(bench.control->status().phase, GraspPhase::kIdle);
  EXPECT_EQ(bench.control->status().last->outcome, GraspOutcome::kFailed);
  std::size_t alarms = 0;
  for (const Event& event : bench.session->takeEvents()) alarms += event.kind == "alarm";
  EXPECT_EQ(alarms, 1u) << "said once";
  bench.hand->fails = nullptr;
  EXPECT_NO_THROW(bench.control->grasp({}));
}

// A failure that comes and goes with every other cycle must not fill the recording.
TEST(GraspFault, TheSameIsSaidAgainAfterTenSecondsOrInANewGrasp) {
  GraspBench bench;
  std::size_t round = 0;
  bool works = true;
  bench.hand->statusFails = [&] {
    if (!works && ++round % 2 == 0) throw std::runtime_error("again and again");
  };
  const auto alarmsOf = [&](std::int64_t us) {
    for (std::int64_t passed = 0; passed < us; passed += 100'000) bench.wait(100'000);
    std::size_t found = 0;
    for (const Event& event : bench.session->takeEvents()) found += event.kind == "alarm";
    return found;
  };
  bench.control->grasp({});
  bench.hand->state.motion->state = PortState::kLost;
  bench.hand->state.motion->unplugged = true;
  EXPECT_EQ(alarmsOf(200'000), 0u);  // from now on it checks whether the port is back
  works = false;
  EXPECT_EQ(alarmsOf(9'000'000), 1u);
  EXPECT_EQ(alarmsOf(5'000'000), 1u) << "ten seconds later";
  works = true;
  bench.hand->state.motion->state = PortState::kStreaming;
  bench.control->grasp({});
  bench.hand->state.motion->state = PortState::kLost;
  bench.hand->state.motion->unplugged = true;
  works = false;
  EXPECT_EQ(alarmsOf(2'000'000), 1u) << "of another grasp";
}

TEST(GraspFault, AnotherLayoutInASlipAwareGraspStopsIt) {
  GraspBench bench;
  bench.control->grasp(slipAware());
  bench.hand->states.assign(7, 1);
  bench.feel(2, 100.0F);
  EXPECT_NO_THROW(feelOther(bench, 50.0F));
  EXPECT_EQ(bench.hand->count<StopMotion>(), 1u);
  bench.wait(1000);
  ASSERT_TRUE(bench.control->status().last.has_value());
  EXPECT_EQ(bench.control->status().last->outcome, GraspOutcome::kFailed);
  EXPECT_NE(bench.control->status().last->text.find("layout"), std::string::npos)
      << bench.control->status().last->text;
}

// The grasp is stopped at once, not only when the stream has been silent for long enough.
TEST(GraspFault, ATactilePortThatFailedStopsAGraspThatFeels) {
  GraspBench bench;
  bench.control->grasp(slipAware());
  bench.hand->states.assign(7, 1);
  bench.feel(2);
  EXPECT_EQ(bench.hand->count<StopMotion>(), 0u);
  bench.hand->state.tactile.state = PortState::kFault;
  bench.wait(5000);
  EXPECT_EQ(bench.hand->count<StopMotion>(), 1u);
}

// The port is back within a second, and the hand is not left without control.
TEST(GraspFault, AMotionPortThatFailedIsToldToStopUntilItAnswers) {
  GraspBench bench;
  bench.control->grasp({});
  bench.hand->states.assign(7, 1);
  bench.feel(2);
  bench.hand->answers = false;
  bench.hand->state.motion->state = PortState::kFault;
  bench.wait(5000);
  ASSERT_EQ(bench.hand->count<StopMotion>(), 1u);
  bench.hand->waiting[0].set_exception(
      std::make_exception_ptr(DeviceError(DeviceFault::kSilent, "/dev/motion", "not connected")));
  bench.wait(300'000);
  ASSERT_EQ(bench.hand->count<StopMotion>(), 2u);
  bench.hand->state.motion->state = PortState::kStreaming;
  bench.hand->waiting[1].set_value({});
  bench.wait(5000);
  EXPECT_EQ(bench.control->status().phase, GraspPhase::kIdle);
  EXPECT_EQ(bench.control->status().last->outcome, GraspOutcome::kFailed);
}

TEST(GraspFault, AnotherLayoutBetweenGraspsIsLearned) {
  GraspBench bench;
  for (int i = 0; i < 20; ++i) feelOther(bench, 0.0F);
  bench.feel(5);
  bench.control->grasp(slipAware());
  bench.hand->states.assign(7, 1);
  bench.feel(3, 100.0F);
  EXPECT_EQ(bench.control->status().phase, GraspPhase::kClosing);
}

// C-A14: a blocked consumer that receives an event of the control must not prevent a stop.
TEST(GraspFault, AConsumerThatHangsKeepsNobodyFromStopping) {
  GraspBench bench;
  CaptureQueueOptions patient;
  patient.eventItems = 1;
  patient.blockWhenFull = true;
  auto hanging = bench.session->subscribe("hangs", patient);
  bench.control->run();
  std::jthread other([&] {
    // The events fill the queue of the blocked consumer and wait for room there.
    for (int i = 0; i < 3; ++i) {
      try {
        bench.control->grasp({});
      } catch (const DeviceError&) {
      }
      bench.control->stop();
    }
    bench.control->status();
    bench.control->takeChanges();
  });
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  std::atomic<bool> done = false;
  std::jthread watch([&] {
    other.join();
    done = true;
  });
  while (!done && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_TRUE(done) << "grasp() or stop() waits for a consumer";
  EXPECT_GE(bench.hand->count<StopMotion>(), 3u);
  hanging.reset();
}

}  // namespace
}  // namespace palpate::grasp_fault_test

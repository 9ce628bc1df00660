// Safety of the hand (R18, docs/notes/safety.md), checked at the motion port of the emulated hand.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/preshape.h"
#include "palpate/recording/recording.h"

#include "control/emulated_bench.h"
#include "control/stop_moments.h"
#include "testing/punctuality.h"
#include "testing/testing.h"

namespace palpate::safety_test {
namespace {
using namespace testing;

constexpr std::int64_t kSilenceUs = 100'000;
constexpr std::int64_t kReactionUs = 20'000;
constexpr std::int64_t kNeverLongerUs = 100'000;

TEST(Safety, ConnectingMovesNothing) {
  EmulatedBench bench(stillHand());
  bench.connect();
  EXPECT_TRUE(eventuallyTrue([&] { return bench.log.named("pos").size() > 20; }));
  bench.control.reset();
  bench.session.reset();
  EXPECT_TRUE(bench.log.deeds().empty()) << bench.log.deeds().front().name;
  EXPECT_TRUE(bench.log.named("stop").empty());
}

TEST(Safety, BeyondARangeOrNoNumberIsRefusedAndNoByteIsSent) {
  EmulatedBench bench(stillHand());
  bench.connect();
  GraspRequest wrong;
  wrong.closeRatio = 1.001;
  EXPECT_THROW(bench.control->grasp(wrong), std::invalid_argument);
  wrong.closeRatio = std::nan("");
  EXPECT_THROW(bench.control->grasp(wrong), std::invalid_argument);
  wrong = {};
  wrong.velocityDegPerS = 101.0;
  EXPECT_THROW(bench.control->grasp(wrong), std::invalid_argument);
  EXPECT_THROW(bench.control->grasp(reactiveGrasp(3601)), std::invalid_argument);
  // Commands that bypass the control are checked by the driver.
  const auto refusedByDriver = [&](std::vector<double> deg, std::vector<double> velocity) {
    auto answer = bench.session->device().submit(MoveJoints{deg, velocity, false});
    EXPECT_THROW(answer.get(), std::invalid_argument);
  };
  refusedByDriver({60, -91, 75, -75, 75, -75, 75}, {});
  refusedByDriver({60, -75, 75, std::nan(""), 75, -75, 75}, {});
  refusedByDriver({60, -75, 75, -75, 75, -75, HUGE_VAL}, {});
  refusedByDriver({-1, -75, 75, -75, 75, -75, 75}, {});
  refusedByDriver({60, -75, 75, -75, 75, -75}, {});  // an axis is missing
  refusedByDriver({60, -75, 75, -75, 75, -75, 75}, {1000, 10, 10, 10, 10, 10, 10});
  refusedByDriver({60, -75, 75, -75, 75, -75, 75}, {10, 10, 10, 10, 10, 10, std::nan("")});
  const std::size_t asked = bench.log.named("pos").size();
  EXPECT_TRUE(eventuallyTrue([&] { return bench.log.named("pos").size() > asked + 5; }));
  EXPECT_TRUE(bench.log.deeds().empty()) << bench.log.deeds().front().name;
}

TEST(Safety, NoAxisIsEverSetToZeroByOmission) {
  EmulatedBench bench(stillHand(), {.rate = EmulationRate::kFixed, .hz = 60.0});
  bench.connect();
  std::vector<std::vector<double>> expected;
  for (const Preshape& preshape : sdh2Preshapes()) {
    GraspRequest request;
    request.preshape = preshape.name;
    request.closeRatio = 0.25;
    request.velocityDegPerS = 90.0;
    ASSERT_NO_THROW(bench.control->grasp(request));
    ASSERT_TRUE(bench.awaitMotion());
    bench.control->stop();
    ASSERT_TRUE(bench.awaitEnd().has_value());
    expected.push_back(preshape.anglesDeg(0.25));
  }
  const auto targets = bench.log.named("p");
  std::size_t set = 0;
  for (const ArrivedCommand& target : targets) {
    if (target.values.empty()) continue;  // a read request
    ASSERT_LT(set, expected.size());
    EXPECT_EQ(target.values, expected[set++]);
  }
  EXPECT_EQ(set, expected.size());
  for (const ArrivedCommand& velocity : bench.log.named("v"))
    if (!velocity.values.empty()) {
      EXPECT_EQ(velocity.values, (std::vector<double>{83, 90, 90, 90, 90, 90, 90}));
    }
  // No other value was ever set, and no built-in grip was requested.
  for (const ArrivedCommand& deed : bench.log.deeds())
    EXPECT_TRUE(deed.name == "p" || deed.name == "v" || deed.name == "vp" || deed.name == "m")
        << deed.name;
}

TEST(Safety, RelaxIsTheOnlyThingThatTakesThePower) {
  EmulatedBench bench(stillHand());
  bench.connect();
  bench.control->preshape("centrical", 50.0);
  bench.control->relax();
  ASSERT_TRUE(eventuallyTrue([&] { return !bench.log.named("power").empty(); }));
  const auto power = bench.log.named("power");
  EXPECT_EQ(power.front().values, std::vector<double>(7, 0.0));
  EXPECT_FALSE(bench.log.named("stop").empty());
  EXPECT_LE(bench.log.named("stop").front().monoUs, power.front().monoUs);
  EXPECT_FALSE(bench.handMoves());
}

// Measures a grasp of the ball from the last byte of the frame over the limit, as it leaves the
// hand, to the arrival of the stop.
void graspUntilTheLimit(Punctuality& reactions, const std::filesystem::path& recorded) {
  constexpr int kLimit = 200;
  std::mutex mutex;
  std::optional<std::uint64_t> crossing;
  const HostTime time;
  EmulatedBench bench(handWith("ball"), {}, [&](const EmulatedFrame& frame) {
    const std::lock_guard lock(mutex);
    if (!crossing && std::any_of(frame.counts.begin(), frame.counts.end(), [](auto counts) {
          return counts > kLimit;
        }))
      crossing = frame.scanned.number;
  });
  bench.connect();
  RecordingOptions recording;
  recording.path = recorded;
  bench.session->startRecording(recording);
  bench.control->grasp(reactiveGrasp(kLimit, 60.0));
  const auto report = bench.awaitEnd();
  ASSERT_TRUE(report.has_value());
  ASSERT_EQ(report->outcome, GraspOutcome::kLimitReached) << report->text;
  EXPECT_GT(report->peak.counts, static_cast<float>(kLimit));
  EXPECT_FALSE(bench.handMoves());
  bench.session->stopRecording();
  const auto stop = bench.log.firstSince("stop", 0);
  ASSERT_TRUE(stop.has_value()) << "no stop came";
  std::int64_t leftUs = 0;  // host time
  for (const SentFrame& frame : bench.hand->sentFrames())
    if (frame.number == crossing.value()) leftUs = frame.hostUs;
  ASSERT_NE(leftUs, 0);
  const std::int64_t hostAheadUs = time.nowUs() - systemClock().monotonicUs();
  reactions.took(leftUs - hostAheadUs, stop->monoUs);
}

TEST(Safety, AReactiveGraspStopsWithinMillisecondsOfTheFrameThatCrosses) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "grasp.palpate";
  Punctuality reactions("frame_over_the_limit_to_stop", {kReactionUs, 1.0, kNeverLongerUs});
  ASSERT_NO_FATAL_FAILURE(graspUntilTheLimit(reactions, path));
  reactions.judge();
  const EventsReport events = readEvents(path);
  const auto count = [&](const std::string& kind) {
    return std::count_if(events.events.begin(), events.events.end(), [&](const auto& event) {
      return event.kind == kind;
    });
  };
  EXPECT_EQ(count("grasp"), 2);
  EXPECT_EQ(count("motion"), 2);  // began, stopped
}

// Ways to end the tactile stream; the hand still receives commands.
struct Death {
  const char* name;
  std::function<void(EmulatedHand&)> happen;
};
class DeadStream : public ::testing::TestWithParam<Death> {};

// Measures the time from the last frame before the failure to the arrival of the stop.
TEST_P(DeadStream, StopsAReactiveGrasp) {
  const Death& death = GetParam();
  Punctuality stops(death.name, {kSilenceUs + kReactionUs, 1.0, kSilenceUs + kNeverLongerUs});
  EmulatedBench bench(stillHand());
  bench.connect();
  bench.control->grasp(reactiveGrasp(200, 10.0));
  ASSERT_TRUE(bench.awaitMotion());
  const std::int64_t beforeUs = systemClock().monotonicUs();
  death.happen(*bench.hand);
  const std::int64_t deadUs = systemClock().monotonicUs();
  ASSERT_TRUE(eventuallyTrue([&] { return bench.log.firstSince("stop", beforeUs).has_value(); }))
      << "no stop came";
  stops.took(deadUs, bench.log.firstSince("stop", beforeUs)->monoUs);
  EXPECT_TRUE(eventuallyTrue([&] { return !bench.handMoves(); }));
  bench.hand->mute(false);
  const auto report = bench.awaitEnd();
  ASSERT_TRUE(report.has_value());
  EXPECT_TRUE(report->outcome == GraspOutcome::kStreamLost ||
              report->outcome == GraspOutcome::kPortGone)
      << report->text;
  stops.judge();
}

INSTANTIATE_TEST_SUITE_P(
    Deaths,
    DeadStream,
    ::testing::Values(Death{"unplugged_to_stop",
                            [](EmulatedHand& hand) { hand.unplug(true, false); }},
                      Death{"silent_to_stop", [](EmulatedHand& hand) { hand.mute(true); }}),
    [](const auto& instance) {
      return instance.param.name[0] == 'u' ? std::string("Unplugged") : std::string("BothSilent");
    });

TEST(Safety, APlainGraspGoesOnWithoutATactileStream) {
  EmulatedBench bench(stillHand());
  bench.connect();
  GraspRequest request;
  request.closeRatio = 0.3;
  request.velocityDegPerS = 60.0;
  bench.control->grasp(request);
  ASSERT_TRUE(bench.awaitMotion());
  bench.hand->unplug(true, false);
  const auto report = bench.awaitEnd();
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->outcome, GraspOutcome::kFinished) << report->text;
  EXPECT_TRUE(bench.log.named("stop").empty());
}

TEST(Safety, AMotionPortThatReturnsBringsAStopBeforeAnythingElse) {
  EmulatedBench bench(stillHand());
  bench.connect();
  GraspRequest request;
  request.closeRatio = 1.0;
  request.velocityDegPerS = 5.0;  // 16 s: still moving when the port is back
  bench.control->grasp(request);
  ASSERT_TRUE(bench.awaitMotion());
  bench.hand->unplug(false, true);
  const auto report = bench.awaitEnd();
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->outcome, GraspOutcome::kPortGone) << report->text;
  EXPECT_TRUE(bench.handMoves());  // as docs/notes/safety.md says: an `m` motion runs to its target
  EXPECT_THROW(bench.control->grasp(request), DeviceError);
  bench.log.restart();
  bench.hand->replug();
  ASSERT_TRUE(eventuallyTrue([&] { return !bench.handMoves(); }));
  ASSERT_FALSE(bench.log.all().empty()) << ::testing::PrintToString(bench.log.pending());
  EXPECT_EQ(bench.log.all().front().name, "stop");
  EXPECT_TRUE(bench.log.deeds().empty());
}

// As after a program that was killed.
TEST(Safety, AHandFoundMovingIsStopped) {
  EmulatedBench bench(stillHand());
  bench.hand->withModel([](HandModel& model) {
    model.joints().setVelocities(std::vector<double>(7, 5.0));
    model.joints().setTargets({60, 7, -7, 7, -7, 7, -7});
    model.joints().startMotion();
  });
  EXPECT_TRUE(bench.handMoves());
  bench.connect();
  EXPECT_TRUE(eventuallyTrue([&] { return !bench.handMoves(); }));
  EXPECT_EQ(bench.log.named("stop").size(), 1u);
  EXPECT_TRUE(bench.log.deeds().empty());
  const auto motion = bench.session->device().status().motion;
  ASSERT_TRUE(motion.has_value());
  EXPECT_GT(motion->foundMovingUs, 0);
  EXPECT_LE(motion->foundMovingUs, bench.session->nowUs());
}

TEST(Safety, AHandFoundAtRestIsNotSaidToHaveMoved) {
  EmulatedBench bench(stillHand());
  bench.connect();
  EXPECT_EQ(bench.session->device().status().motion->foundMovingUs, 0);
}

TEST(Safety, ClosingTheSessionInAMotionStopsTheHand) {
  EmulatedBench bench(stillHand());
  bench.connect();
  GraspRequest request;
  request.closeRatio = 1.0;
  bench.control->grasp(request);
  ASSERT_TRUE(bench.awaitMotion());
  bench.session->stop();
  EXPECT_FALSE(bench.handMoves());
  EXPECT_FALSE(bench.log.named("stop").empty());
  const auto report = bench.awaitEnd();
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->outcome, GraspOutcome::kPortGone) << report->text;
}

TEST(Safety, SettingsOfTheTactileControllerDoNotChangeInAReactiveGrasp) {
  EmulatedBench bench(stillHand());
  bench.connect();
  bench.control->grasp(reactiveGrasp(200, 10.0));
  ASSERT_TRUE(bench.awaitMotion());
  EXPECT_THROW(bench.control->change(SetThreshold{{}, 0}), DeviceError);
  bench.control->stop();
  ASSERT_TRUE(bench.awaitEnd().has_value());
  bench.control->change(SetThreshold{2, 77}).get();
  std::vector<int> thresholds;
  bench.hand->withModel([&](HandModel& model) {
    for (const MatrixSetting& setting : model.settings())
      thresholds.push_back(setting.thresholdCounts);
  });
  EXPECT_EQ(thresholds, (std::vector<int>{150, 300, 77, 300, 150, 300}));
}

TEST(Safety, AHeapOfSettingsArrivesWhole) {
  EmulatedBench bench(stillHand());
  bench.connect();
  std::vector<std::shared_future<CommandAnswer>> answers;
  for (int m = 0; m < 6; ++m) answers.push_back(bench.control->change(SetThreshold{m, 50 + m}));
  answers.push_back(bench.control->change(SetSensitivity{4, 0.75}));
  for (const auto& answer : answers) EXPECT_NO_THROW(answer.get());
  bench.hand->withModel([&](HandModel& model) {
    for (int m = 0; m < 6; ++m)
      EXPECT_EQ(model.settings()[static_cast<std::size_t>(m)].thresholdCounts, 50 + m);
    EXPECT_NEAR(model.settings()[4].sensitivity, 0.75, 1e-6);
  });
}

TEST(Safety, StopAtRandomMomentsIsOnTheWireWithinTwentyMilliseconds) {
  stopAtRandomMoments(30, 150'000);
}

}  // namespace
}  // namespace palpate::safety_test

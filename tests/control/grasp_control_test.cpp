#include "palpate/control/grasp_control.h"

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "palpate/capture/replay.h"
#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/recording.h"

#include "control/scripted_hand.h"
#include "testing/testing.h"

namespace palpate::grasp_control_test {
namespace {
using testing::GraspBench;

GraspRequest reactive(int limit = 200) {
  GraspRequest request;
  request.mode = GraspMode::kReactive;
  request.closeRatio = 1.0;
  request.limitCounts = limit;
  return request;
}

TEST(GraspControl, ConnectingSendsNothing) {
  GraspBench bench;
  bench.feel(50, 2000.0F);
  bench.wait(10'000'000);
  EXPECT_TRUE(bench.hand->commands.empty());
  bench.control.reset();
  EXPECT_TRUE(bench.hand->commands.empty());
}

TEST(GraspControl, SaysOfSwappedPortsThatTheyAre) {
  GraspBench bench;
  bench.hand->state.tactile.found = PortAnswer::kMotion;
  bench.hand->state.motion->state = PortState::kConnecting;
  bench.hand->state.motion->message = "no motion controller answers here; check cable and power";
  EXPECT_EQ(bench.control->status().cannotMove, "the two ports are swapped");
}

TEST(GraspControl, ReactiveGraspStopsWithTheFrameThatCrossesTheLimit) {
  GraspBench bench;
  bench.control->grasp(reactive(200));
  ASSERT_EQ(bench.hand->count<MoveJoints>(), 1u);
  bench.hand->states.assign(7, 1);
  bench.feel(5, 199.0F);
  EXPECT_EQ(bench.hand->count<StopMotion>(), 0u);
  bench.feel(1, 250.0F);  // one cycle
  EXPECT_EQ(bench.hand->count<StopMotion>(), 1u);
  EXPECT_EQ(bench.control->status().phase, GraspPhase::kSettling);
  bench.feel(17, 240.0F);
  EXPECT_EQ(bench.hand->count<StopMotion>(), 1u);
  const GraspStatus status = bench.control->status();
  EXPECT_EQ(status.phase, GraspPhase::kIdle);
  ASSERT_TRUE(status.last.has_value());
  EXPECT_EQ(status.last->outcome, GraspOutcome::kLimitReached);
  EXPECT_EQ(status.last->text, "limit reached: finger 2 distal, x 1, y 6: 250 counts");
}

TEST(GraspControl, TellsWhatHappensInOrder) {
  GraspBench bench;
  GraspRequest request = reactive(200);
  request.startRatio = 0.0;
  bench.hand->answers = false;
  bench.control->grasp(request);
  bench.hand->states.assign(7, 1);
  bench.hand->waiting[0].set_value({.durationS = 0.05});
  bench.feel(1);
  bench.hand->states.assign(7, 0);
  bench.feel(3);
  ASSERT_EQ(bench.hand->count<MoveJoints>(), 2u);
  bench.hand->waiting[1].set_value({.durationS = 2.0});
  bench.hand->states.assign(7, 1);
  bench.feel(2, 300.0F);
  ASSERT_EQ(bench.hand->count<StopMotion>(), 1u);
  bench.hand->waiting[2].set_value({});
  bench.wait(1000);
  bench.feel(17, 300.0F);
  std::vector<GraspPhase> phases;
  std::vector<GraspChange> changes = bench.control->takeChanges();
  for (const GraspChange& change : changes) phases.push_back(change.phase);
  EXPECT_EQ(phases,
            (std::vector<GraspPhase>{GraspPhase::kPreshaping,
                                     GraspPhase::kClosing,
                                     GraspPhase::kStopping,
                                     GraspPhase::kSettling,
                                     GraspPhase::kIdle}));
  ASSERT_TRUE(changes.back().report.has_value());
  EXPECT_EQ(changes.back().report->outcome, GraspOutcome::kLimitReached);
  EXPECT_TRUE(bench.control->takeChanges().empty());
}

TEST(GraspControl, ARecordingHoldsWhatHappened) {
  const testing::TemporaryFolder folder;
  GraspBench bench;
  RecordingOptions options;
  options.path = folder / "grasp.palpate";
  bench.session->startRecording(options);
  bench.control->grasp(reactive(200));
  bench.hand->states.assign(7, 1);
  bench.feel(10, 100.0F);
  bench.feel(1, 222.0F);
  bench.feel(17, 1000.0F);
  EXPECT_THROW(bench.control->grasp(reactive(100)), DeviceError);  // over the limit already
  bench.session->step();
  bench.session->stopRecording();
  const EventsReport events = readEvents(folder / "grasp.palpate");
  std::vector<Event> grasps;
  for (const Event& event : events.events)
    if (event.kind == "grasp") grasps.push_back(event);
  ASSERT_EQ(grasps.size(), 3u);
  EXPECT_FALSE(Json::parse(grasps[0].json).contains("outcome"));
  EXPECT_EQ(Json::parse(grasps[1].json).at("outcome").asString(), "limit_reached");
  EXPECT_EQ(Json::parse(grasps[1].json).at("counts").asDouble(), 222.0);
  EXPECT_EQ(grasps[1].matrix, 5);
  EXPECT_EQ(Json::parse(grasps[1].json).at("reached_counts").asDouble(), 1000.0);
  EXPECT_EQ(grasps[1].t1Us - grasps[1].tUs, 11 * 30'000) << "the frame over the limit";
  EXPECT_EQ(Json::parse(grasps[2].json).at("outcome").asString(), "refused");
}

TEST(GraspControl, RefusesBadValuesBeforeAnythingIsSent) {
  GraspBench bench;
  GraspRequest request;
  request.closeRatio = std::nan("");
  EXPECT_THROW(bench.control->grasp(request), std::invalid_argument);
  request = {};
  request.velocityDegPerS = 1000.0;
  EXPECT_THROW(bench.control->grasp(request), std::invalid_argument);
  EXPECT_THROW(bench.control->grasp(reactive(4000)), std::invalid_argument);
  EXPECT_THROW(bench.control->preshape("fist", 20.0), std::invalid_argument);
  EXPECT_TRUE(bench.hand->commands.empty());
  EXPECT_EQ(bench.control->status().last->outcome, GraspOutcome::kRefused);
}

// L-M2: uses the settings of the matrices as reported by the controller.
TEST(GraspControl, RefusesATactileGraspWhoseLimitCannotBeFelt) {
  GraspBench bench;
  bench.hand->says.matrices.assign(6, {0.5, 150});
  bench.hand->says.matrices[1].thresholdCounts = 4095;
  try {
    bench.control->grasp(reactive());
    ADD_FAILURE() << "accepted";
  } catch (const DeviceError& error) {
    EXPECT_NE(std::string(error.what()).find("finger 0 distal"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(bench.hand->commands.empty());
  EXPECT_EQ(bench.control->status().last->outcome, GraspOutcome::kRefused);
  EXPECT_NO_THROW(bench.control->grasp({}));  // a plain grasp needs no limit
}

TEST(GraspControl, RefusesWithoutAMotionPort) {
  GraspBench bench;
  bench.hand->state.motion->state = PortState::kLost;
  bench.hand->state.motion->message = "/dev/motion: unplugged";
  EXPECT_THROW(bench.control->grasp({}), DeviceError);
  EXPECT_EQ(bench.control->status().cannotMove, "/dev/motion: unplugged");
  bench.hand->state.motion.reset();
  EXPECT_THROW(bench.control->grasp({}), DeviceError);
  EXPECT_TRUE(bench.hand->commands.empty());
  EXPECT_EQ(bench.control->status().cannotMove, "no motion port is connected");
}

TEST(GraspControl, RefusesAReactiveGraspWhenNoFramesCome) {
  GraspBench bench;
  bench.wait(150'000);
  EXPECT_EQ(bench.control->status().cannotReact, "no tactile frames come");
  EXPECT_THROW(bench.control->grasp(reactive()), DeviceError);
  EXPECT_TRUE(bench.hand->commands.empty());
}

TEST(GraspControl, SilenceStopsAReactiveGrasp) {
  GraspBench bench;
  bench.control->grasp(reactive());
  bench.hand->states.assign(7, 1);
  bench.feel(3);
  bench.wait(100'000);
  EXPECT_EQ(bench.hand->count<StopMotion>(), 0u);
  bench.wait(1);
  EXPECT_EQ(bench.hand->count<StopMotion>(), 1u);
  bench.wait(1);
  EXPECT_EQ(bench.control->status().last->outcome, GraspOutcome::kStreamLost);
}

// Holds with 250 counts on one taxel.
void hold(GraspBench& bench) {
  GraspRequest request = reactive(200);
  request.mode = GraspMode::kSlip;
  bench.control->grasp(request);
  bench.feel(1, 250.0F);
  bench.feel(20, 250.0F);
  ASSERT_EQ(bench.control->condition().condition, HandCondition::kWatched);
}

std::vector<std::string> textsOf(CaptureSession& session, const std::string& kind) {
  std::vector<std::string> texts;
  for (const Event& event : session.takeEvents())
    if (event.kind == kind) texts.push_back(event.text);
  return texts;
}

TEST(GraspControl, AProtectionThatEndedIsToldUntilItIsAcknowledged) {
  GraspBench bench;
  ASSERT_NO_FATAL_FAILURE(hold(bench));
  bench.wait(101'000);
  EXPECT_EQ(bench.control->condition().condition, HandCondition::kNotProtected);
  EXPECT_TRUE(bench.control->condition().sentence.starts_with("no tactile frames for 101 ms"));
  EXPECT_EQ(bench.control->status().phase, GraspPhase::kHolding);
  bench.control->acknowledge();  // it still goes on
  bench.session->takeEvents();
  bench.wait(900'000);
  const std::string why = "no more tactile frames arrive: the hand holds, without slip detection";
  EXPECT_EQ(bench.control->status().phase, GraspPhase::kIdle);
  EXPECT_EQ(bench.control->status().unprotected, why);
  EXPECT_EQ(textsOf(*bench.session, "alarm"), std::vector<std::string>{"not protected: " + why});
  bench.feel(20, 250.0F);
  bench.control->stop();
  EXPECT_THROW(bench.control->grasp(reactive(100)), DeviceError);  // over the limit already
  EXPECT_EQ(bench.control->condition(), (ExplainedCondition{HandCondition::kNotProtected, why}));
  bench.session->takeEvents();
  bench.control->acknowledge();
  EXPECT_EQ(textsOf(*bench.session, "grasp"),
            std::vector<std::string>{"acknowledged: not protected: " + why});
  EXPECT_EQ(bench.control->condition().condition, HandCondition::kHolding);
  bench.control->acknowledge();
  EXPECT_TRUE(bench.session->takeEvents().empty()) << "once";
}

// It may have been switched off and on, or be another one in the same place.
TEST(GraspControl, WhatAHandHoldsThatWasAwayIsNotKnown) {
  GraspBench bench;
  bench.control->grasp(reactive(200));
  bench.feel(1, 250.0F);
  bench.feel(20, 250.0F);
  ASSERT_EQ(bench.control->condition().condition, HandCondition::kHolding);
  bench.hand->state.motion->state = PortState::kLost;
  bench.wait(5000);
  EXPECT_EQ(bench.control->condition().condition, HandCondition::kGone);
  bench.hand->state.motion->state = PortState::kStreaming;
  ++bench.hand->state.motion->reconnects;
  bench.wait(5000);
  const ExplainedCondition back = bench.control->condition();
  EXPECT_EQ(back.condition, HandCondition::kNotProtected);
  EXPECT_TRUE(back.sentence.ends_with("is not known")) << back.sentence;
  bench.control->acknowledge();
  EXPECT_EQ(bench.control->condition().condition, HandCondition::kReady);
  EXPECT_TRUE(bench.control->status().wasAway);
}

TEST(GraspControl, AProtectionThatEndedSaysThatThePortIsBack) {
  GraspBench bench;
  ASSERT_NO_FATAL_FAILURE(hold(bench));
  bench.hand->state.tactile.state = PortState::kLost;
  bench.hand->state.tactile.message = "unplugged";
  bench.wait(1);
  const std::string why = bench.control->condition().sentence;
  ASSERT_TRUE(why.starts_with("the tactile port is gone")) << why;
  bench.hand->state.tactile.state = PortState::kStreaming;
  for (int time = 0; time < 2; ++time) {
    ++bench.hand->state.tactile.reconnects;
    bench.wait(5000);
    EXPECT_EQ(
        bench.control->condition(),
        (ExplainedCondition{HandCondition::kNotProtected, "before the port came back: " + why}));
  }
}

TEST(GraspControl, TheNextMotionAndRelaxAcknowledge) {
  for (const bool relaxes : {false, true}) {
    GraspBench bench;
    ASSERT_NO_FATAL_FAILURE(hold(bench));
    bench.hand->state.tactile.state = PortState::kLost;
    bench.hand->state.tactile.message = "unplugged";
    bench.wait(1);
    ASSERT_EQ(bench.control->condition().condition, HandCondition::kNotProtected);
    if (relaxes)
      bench.control->relax();
    else
      bench.control->preshape("centrical", 10.0);
    EXPECT_TRUE(bench.control->status().unprotected.empty());
    EXPECT_EQ(bench.control->condition().condition,
              relaxes ? HandCondition::kRelaxed : HandCondition::kMoving);
  }
}

// The reading of what is held is above the limit; a slip-aware grasp watches it, unless the hand
// may have let go.
TEST(GraspControl, WatchesWhatIsHeldUnlessTheHandMayHaveLetGo) {
  using Between = std::function<void(GraspBench&)>;
  const auto reconnect = [](GraspBench& bench, PortStatus& port) {
    port.state = PortState::kLost;
    bench.wait(1);
    port.state = PortState::kStreaming;
    ++port.reconnects;
    bench.feel(20, 260.0F);
  };
  const std::pair<const char*, Between> table[] = {
      {"", [](GraspBench&) {}},
      {"the motors were off",
       [](GraspBench& bench) {
         bench.control->relax();
         bench.feel(2, 260.0F);
       }},
      {"the motion port was gone",
       [&](GraspBench& bench) { reconnect(bench, *bench.hand->state.motion); }},
      {"the tactile port was gone",
       [&](GraspBench& bench) { reconnect(bench, bench.hand->state.tactile); }},
  };
  for (const auto& [why, between] : table) {
    GraspBench bench;
    bench.hand->sink->onSample({bench.clock.hostUs(), std::vector<double>(7, 20.0)});
    GraspRequest request = reactive(200);
    bench.control->grasp(request);
    bench.feel(1, 250.0F);
    bench.feel(30, 260.0F);
    ASSERT_EQ(bench.control->status().last->outcome, GraspOutcome::kLimitReached);
    between(bench);
    request.mode = GraspMode::kSlip;
    const std::string_view refused = why;
    if (!refused.empty()) {
      EXPECT_THROW(bench.control->grasp(request), DeviceError) << why;
      continue;
    }
    const auto moves = bench.hand->count<MoveJoints>();
    ASSERT_NO_THROW(bench.control->grasp(request));
    bench.feel(30, 260.0F);
    EXPECT_EQ(bench.control->condition().condition, HandCondition::kWatched);
    EXPECT_EQ(bench.hand->count<MoveJoints>(), moves) << "nothing moves";
  }
}

TEST(GraspControl, ChangesTellTheConditionOfTheHand) {
  GraspBench bench;
  ASSERT_NO_FATAL_FAILURE(hold(bench));
  bench.wait(150'000);
  bench.feel(2, 250.0F);
  bench.control->stop();
  bench.wait(1);
  std::vector<std::string> words;
  for (const GraspChange& change : bench.control->takeChanges())
    if (const std::string word(nameOf(change.condition.condition));
        words.empty() || words.back() != word)
      words.push_back(word);
  EXPECT_EQ(words,
            (std::vector<std::string>{"moving",
                                      "holding",
                                      "holding and watched",
                                      "not protected",
                                      "holding and watched",
                                      "stopped"}));
}

TEST(GraspControl, SettingsAreRefusedWhileFingersMoveUnderTactileControl) {
  GraspBench bench;
  bench.hand->states.assign(7, 1);
  bench.control->grasp(reactive());
  EXPECT_THROW(bench.control->change(SetThreshold{{}, 10}), DeviceError);
  EXPECT_THROW(bench.control->change(SetSensitivity{1, 0.9}), DeviceError);
  EXPECT_THROW(bench.control->change(SetDynamicMask{0, Mask(84, 1)}), DeviceError);
  EXPECT_EQ(bench.hand->commands.size(), 1u);  // the motion
  EXPECT_FALSE(bench.control->status().cannotChange.empty());
  bench.control->stop();
  bench.wait(1);
  EXPECT_TRUE(bench.control->status().cannotChange.empty());
  EXPECT_NO_THROW(bench.control->change(SetThreshold{{}, 10}).get());
  bench.control->grasp({});  // plain: the settings do not matter to it
  EXPECT_NO_THROW(bench.control->change(SetSensitivity{1, 0.9}));
  EXPECT_THROW(bench.control->change(StopMotion{}), std::invalid_argument);
}

TEST(GraspControl, AReactiveGraspWaitsForSettingsThatAreBeingChanged) {
  GraspBench bench;
  bench.hand->answers = false;
  const auto answer = bench.control->change(SetThreshold{{}, 100});
  EXPECT_THROW(bench.control->grasp(reactive()), DeviceError);
  bench.hand->waiting[0].set_value({});
  EXPECT_NO_THROW(bench.control->grasp(reactive()));
}

TEST(GraspControl, AStopGoesOutInTheCallItselfAndAlways) {
  GraspBench bench;
  bench.hand->answers = false;
  bench.control->stop();  // no known motion runs
  EXPECT_EQ(bench.hand->count<StopMotion>(), 1u);
  bench.control->grasp({});
  bench.control->stop();
  EXPECT_EQ(bench.hand->count<StopMotion>(), 2u);
  bench.control->stop();  // the first one is not answered yet
  EXPECT_EQ(bench.hand->count<StopMotion>(), 3u);
  // No motion follows it.
  bench.wait(100'000);
  EXPECT_EQ(bench.hand->count<MoveJoints>(), 1u);
  EXPECT_TRUE(std::holds_alternative<StopMotion>(bench.hand->commands.back()));
}

TEST(GraspControl, NoSecondMotionFollowsAStopBetweenTheTwoOfAGrasp) {
  GraspBench bench;
  GraspRequest request = reactive();
  request.startRatio = 0.0;
  bench.hand->durationS = 0.05;
  bench.control->grasp(request);
  bench.hand->states.assign(7, 1);
  bench.feel(2);
  bench.control->stop();
  bench.hand->states.assign(7, 0);
  bench.feel(50);
  EXPECT_EQ(bench.hand->count<MoveJoints>(), 1u);
  EXPECT_EQ(bench.control->status().last->outcome, GraspOutcome::kStopped);
}

TEST(GraspControl, RelaxStopsAndSwitchesTheMotorsOff) {
  GraspBench bench;
  bench.control->grasp({});
  bench.control->relax();
  ASSERT_EQ(bench.hand->commands.size(), 3u);
  EXPECT_TRUE(std::holds_alternative<StopMotion>(bench.hand->commands[1]));
  EXPECT_FALSE(std::get<SetPower>(bench.hand->commands[2]).on);
  EXPECT_EQ(bench.control->status().last->outcome, GraspOutcome::kRelaxed);
  EXPECT_EQ(bench.control->status().phase, GraspPhase::kIdle);
  EXPECT_TRUE(bench.control->status().motorsOff);
}

TEST(GraspControl, AHandThatStandsStillIsRelaxedNotSilently) {
  GraspBench bench;
  EXPECT_FALSE(bench.control->status().motorsOff);
  bench.control->relax();
  EXPECT_TRUE(bench.control->status().motorsOff);
  std::vector<std::string> said;
  for (const Event& event : bench.session->takeEvents())
    if (event.kind == "grasp") said.push_back(event.text);
  EXPECT_EQ(said, std::vector<std::string>{"relaxed by the user: the motors are off"});
  bench.control->stop();
  EXPECT_TRUE(bench.control->status().motorsOff) << "a stop switches nothing on";
  bench.control->grasp({});
  EXPECT_FALSE(bench.control->status().motorsOff);
}

TEST(GraspControl, AMotionPortThatGoesAwayEndsTheGrasp) {
  GraspBench bench;
  bench.control->grasp({});
  bench.hand->state.motion->state = PortState::kLost;
  bench.hand->state.motion->unplugged = true;
  bench.hand->state.motion->message = "unplugged";
  bench.wait(5000);
  EXPECT_EQ(bench.control->status().last->outcome, GraspOutcome::kPortGone);
}

TEST(GraspControl, ClosingStopsWhatRuns) {
  GraspBench bench;
  bench.control->grasp({});
  bench.control.reset();
  EXPECT_EQ(bench.hand->count<StopMotion>(), 1u);
}

TEST(GraspControl, ARecordingThatIsReplayedCannotBeMoved) {
  SyntheticOptions options;
  options.durationS = 5.0;
  ReplayOptions byHand;
  byHand.pace = ReplayPace::kManual;
  testing::HandClock clock;
  CaptureOptions capture;
  capture.ownThread = false;
  auto replay = std::make_unique<Replay>(synthesize(options), byHand, std::vector<Event>{}, clock);
  Replay& source = *replay;
  CaptureSession session(std::move(replay), capture, clock);
  GraspControl control(session, clock);
  session.start();
  source.advance(1'000'000);
  control.step();
  try {
    control.grasp({});
    control.step();
    EXPECT_EQ(control.status().last->outcome, GraspOutcome::kRefused);
  } catch (const DeviceError&) {
    // Each refusal must come at once.
  }
  EXPECT_EQ(control.status().phase, GraspPhase::kIdle);
}

// The test controls the time, but must wait until the thread has processed the frames.
TEST(GraspControl, RunsOnAThreadOfItsOwn) {
  GraspBench bench;
  bench.control->run();
  bench.control->grasp(reactive());
  bench.hand->sink->onFrame([&] {
    TactileFrame frame(sdh2().layout);
    frame.hostUs = bench.clock.hostUs() + 1;
    frame.matrix(0)(0, 0) = 500.0F;
    return frame;
  }());
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  const auto await = [&](GraspPhase phase) {
    while (bench.control->status().phase != phase && std::chrono::steady_clock::now() < deadline)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  await(GraspPhase::kSettling);
  bench.clock.pass(600'000);  // it observes for half a second how far the reading rises
  await(GraspPhase::kIdle);
  ASSERT_TRUE(bench.control->status().last.has_value());
  EXPECT_EQ(bench.control->status().last->outcome, GraspOutcome::kLimitReached);
}

// A motion that follows another one by itself must not begin after a stop.
TEST(GraspControl, AMotionThatAStopCameBeforeIsRefused) {
  GraspBench bench;
  const std::uint64_t stops = bench.control->status().stopsAsked;
  bench.control->stop();
  const std::size_t sent = bench.hand->commands.size();
  EXPECT_THROW(bench.control->grasp({}, stops), DeviceError);
  EXPECT_EQ(bench.hand->commands.size(), sent);
  EXPECT_NE(bench.control->status().last->text.find("the hand was stopped"), std::string::npos);
  EXPECT_NO_THROW(bench.control->grasp({}, stops + 1));
}

}  // namespace
}  // namespace palpate::grasp_control_test

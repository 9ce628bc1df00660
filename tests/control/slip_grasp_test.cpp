// Slip-aware grasps of the emulated hand: the held object is pulled, and must stay.
#include <algorithm>

#include "palpate/control/hand_condition.h"
#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/device/sdh2.h"

#include "control/held_object.h"
#include "control/machine_bench.h"
#include "testing/testing.h"

namespace palpate::slip_grasp_test {
namespace {

using testing::HeldObject;

Scene sceneOf(const std::string& name) {
  Scene scene = loadScene(name, testing::dataFolder() / "scenes");
  scene.script.clear();
  return scene;
}

// Pulls the object from `atS` on with increasing force.
void pull(Scene& scene, double atS, const Eigen::Vector3d& forceN, double growsS) {
  LoadObject load;
  load.forceN = forceN;
  load.durationS = growsS;
  scene.script.push_back({atS, load});
}

GraspRequest slipAware(const std::string& preshape, int limit) {
  GraspRequest request;
  request.mode = GraspMode::kSlip;
  request.preshape = preshape;
  request.closeRatio = 1.0;
  request.velocityDegPerS = 25.0;
  request.limitCounts = limit;
  return request;
}

TEST(SlipGrasp, HoldsWhatRestsAndMovesNothing) {
  HeldObject held(sceneOf("bottle"));
  GraspRequest request = slipAware("cylindrical", 400);
  request.velocityDegPerS = 8.0;
  held.begin(request);
  ASSERT_TRUE(held.run(8.0, [&] { return held.machine().phase() == GraspPhase::kHolding; }));
  const std::uint64_t orderCount = held.hand().joints().orderCount();
  held.run(4.0);
  EXPECT_EQ(held.machine().phase(), GraspPhase::kHolding);
  EXPECT_EQ(held.machine().running().slips, 0);
  EXPECT_EQ(held.hand().joints().orderCount(), orderCount);
  EXPECT_EQ(held.actions("holding"), 1);
  // The run went on for 4 s after the frame in which it began to hold.
  EXPECT_TRUE(held.machine().holdingText(held.us()).starts_with(
      "holding for 4 s, 0 slips answered: limit 400 counts"))
      << held.machine().holdingText(held.us());
  EXPECT_TRUE(held.machine()
                  .holdingText(held.us() + 60'000'000)
                  .starts_with("holding for 64 s, 0 slips answered: limit 400 counts"));
}

// A reactive grasp stopped at its limit, and its reading has crept above it since.
struct LeftAtItsLimit {
  HeldObject held{sceneOf("ball")};
  GraspRequest request = slipAware("centrical", 200);

  LeftAtItsLimit() {
    request.velocityDegPerS = 8.0;
    request.mode = GraspMode::kReactive;
    held.begin(request);
    EXPECT_TRUE(held.run(20.0, [&] { return !held.machine().active(); }));
    EXPECT_EQ(held.machine().running().outcome, GraspOutcome::kLimitReached);
    held.run(5.0);
    EXPECT_GT(held.machine().peak().counts, 200.0F);
    request.mode = GraspMode::kSlip;
  }
};

TEST(SlipGrasp, WatchesWhatIsHeldAtTheSameLimitAlready) {
  LeftAtItsLimit left;
  HeldObject& held = left.held;
  const std::uint64_t orderCount = held.hand().joints().orderCount();
  held.begin(left.request);
  EXPECT_EQ(held.machine().phase(), GraspPhase::kSettling);
  held.run(4.0);
  EXPECT_EQ(held.machine().phase(), GraspPhase::kHolding);
  EXPECT_EQ(held.hand().joints().orderCount(), orderCount) << "nothing moves";
  held.machine().stop(held.us());
  held.run(1.0);
  ASSERT_FALSE(held.machine().active());
  held.begin(left.request);
  EXPECT_EQ(held.machine().phase(), GraspPhase::kSettling) << "what was stopped still holds";
}

// Slips of what was held already are answered as of any other grasp.
TEST(SlipGrasp, ClosesAgainUponASlipOfWhatWasHeldAlready) {
  Scene scene = sceneOf("slipping_handle");
  pull(scene, 24.0, {0.0, 0.0, 12.5}, 6.0);
  pull(scene, 33.0, {0.0, 0.0, 0.0}, 0.2);
  HeldObject held(scene);
  GraspRequest request = slipAware("pinch-parallel", 400);
  request.velocityDegPerS = 8.0;
  request.mode = GraspMode::kReactive;
  held.begin(request);
  ASSERT_TRUE(held.run(18.0, [&] { return !held.machine().active(); }));
  request.mode = GraspMode::kSlip;
  held.begin(request);
  held.run(38.0 - held.timeS());
  EXPECT_EQ(held.actions("already"), 1);
  EXPECT_EQ(held.machine().phase(), GraspPhase::kHolding);
  EXPECT_GE(held.machine().running().slips, 1);
  EXPECT_EQ(held.contacts(), 2) << "the handle stays";
}

// A reactive grasp ended at 300 counts with a limit of 200.
struct EndedAtItsLimit {
  testing::MachineBench bench;
  GraspRequest request = testing::reactive();

  explicit EndedAtItsLimit(const GraspRequest& first = testing::reactive()) {
    bench.machine.onAngles(std::vector<double>(7, 20.0), bench.us);
    bench.begin(first);
    bench.take();
    bench.frames(1, 250.0F);
    EXPECT_TRUE(bench.takeStop());
    bench.machine.onStopAcknowledged(bench.us);
    bench.lookOn(300.0F);
    EXPECT_FALSE(bench.machine.active());
    request.mode = GraspMode::kSlip;
  }
  bool isRefused() {
    try {
      bench.begin(request);
    } catch (const DeviceError&) {
      return true;
    }
    EXPECT_FALSE(bench.machine.takeCommand()) << "what is held already isn't moved";
    return false;
  }
};

TEST(SlipGrasp, AboveItsLimitIsRefusedUnlessTheHandHoldsThatAlready) {
  EXPECT_FALSE(EndedAtItsLimit().isRefused());
  using Between = std::function<void(EndedAtItsLimit&)>;
  const std::pair<const char*, Between> table[] = {
      {"another limit", [](auto& ended) { ended.request.limitCounts = 190; }},
      {"another preshape", [](auto& ended) { ended.request.preshape = "cylindrical"; }},
      {"it would open at its first slip", [](auto& ended) { ended.request.closeRatio = 0.5; }},
      {"another object", [](auto& ended) { ended.request.object = "pen"; }},
      {"the limit is to be kept", [](auto& ended) { ended.request.keepsLimit = true; }},
      {"it would move first", [](auto& ended) { ended.request.startRatio = 0.0; }},
      {"the motors were off", [](auto& ended) { ended.bench.machine.forgetHeld(); }},
      {"a joint moved",
       [](auto& ended) {
         std::vector<double> deg(7, 20.0);
         deg[3] = 20.3;
         ended.bench.machine.onAngles(deg, ended.bench.us);
       }},
      {"nothing was touched for a frame",
       [](auto& ended) {
         ended.bench.frames(1, 0.0F);
         ended.bench.frames(1, 300.0F);
       }},
      {"more than creep explains", [](auto& ended) { ended.bench.frames(1, 460.0F); }},
      {"counts mean something else",
       [](auto& ended) {
         ended.bench.machine.setSettings(std::vector<MatrixSettings>(6, {0.5, 100}));
       }},
      {"another calibration", [](auto& ended) { ended.bench.machine.setCalibration({}); }},
  };
  for (const auto& [why, between] : table) {
    EndedAtItsLimit ended;
    between(ended);
    EXPECT_TRUE(ended.isRefused()) << why;
  }
  GraspRequest joint = testing::reactive();
  joint.targetDeg.assign(7, {});
  joint.targetDeg[1] = 30.0;
  EXPECT_TRUE(EndedAtItsLimit(joint).isRefused()) << "a motion of joints is no grasp";
}

// Below its limit it closes to the limit, as ever.
TEST(SlipGrasp, BelowItsLimitClosesEvenIfItHoldsAlready) {
  EndedAtItsLimit ended;
  ended.bench.frames(1, 150.0F);
  ended.bench.begin(ended.request);
  EXPECT_TRUE(ended.bench.machine.takeCommand());
}

// The reading rises from 250 to 1200 counts after the stop, and falls again while it is held.
TEST(SlipGrasp, TellsOfARiseOnlyWhileTheReadingIsThatHigh) {
  testing::MachineBench bench;
  bench.begin(slipAware("centrical", 200));
  bench.take();
  bench.frames(1, 250.0F);
  ASSERT_TRUE(bench.takeStop());
  bench.machine.onStopAcknowledged(bench.us);
  bench.frames(20, 1200.0F);
  ASSERT_EQ(bench.machine.phase(), GraspPhase::kHolding);
  EXPECT_EQ(bench.machine.holdingText(bench.us),
            "holding for 0 s, 0 slips answered: limit 200 counts; rose to 1200 counts after the "
            "stop, 6.0 times the limit: close more slowly");
  // Half of the rise of 950 counts is left at 725.
  bench.frames(1, 730.0F);
  EXPECT_NE(bench.machine.holdingText(bench.us).find("rose to 1200"), std::string::npos);
  bench.frames(1, 720.0F);
  EXPECT_EQ(bench.machine.holdingText(bench.us),
            "holding for 0 s, 0 slips answered: limit 200 counts");
}

struct Pulled {
  int contacts = 0;
  int slips = 0;
  int limit = 0;
  GraspPhase phase = GraspPhase::kIdle;
  std::string holding;
  std::string log;
  std::vector<std::string> actions;
};

// Pulls a smooth handle out of a pinch with increasing force, until the pull ends.
Pulled pullTheHandle(GraspMode mode, const HoldingOptions& holding = {}) {
  Scene scene = sceneOf("slipping_handle");
  pull(scene, 8.0, {0.0, 0.0, 12.5}, 6.0);
  pull(scene, 17.0, {0.0, 0.0, 0.0}, 0.2);
  HeldObject held(scene);
  GraspRequest request = slipAware("pinch-parallel", 400);
  request.mode = mode;
  request.velocityDegPerS = 8.0;
  request.holding = holding;
  held.begin(request);
  held.run(22.0);
  Pulled pulled{held.contacts(),
                held.machine().running().slips,
                held.machine().running().limitCounts,
                held.machine().phase(),
                held.machine().holdingText(held.us()),
                {},
                {}};
  for (const GraspStep& note : held.notes()) {
    pulled.log += note.action + ": " + note.text + "\n";
    pulled.actions.push_back(note.action);
  }
  return pulled;
}

TEST(SlipGrasp, ClosesAgainUponWhatSlipsAndItStays) {
  EXPECT_EQ(pullTheHandle(GraspMode::kReactive).contacts, 0);  // the handle is lost
  const Pulled aware = pullTheHandle(GraspMode::kSlip);
  EXPECT_EQ(aware.contacts, 2) << aware.log;
  EXPECT_EQ(aware.phase, GraspPhase::kHolding) << aware.log;
  EXPECT_GE(aware.slips, 2) << aware.log;
  EXPECT_GT(aware.limit, 400) << aware.log;
  EXPECT_LE(aware.limit, kMaxSlipLimitCounts) << aware.log;
  // Whatever was the last step, it tells how it holds now.
  EXPECT_NE(aware.holding.find(": limit " + std::to_string(aware.limit)), std::string::npos)
      << aware.holding;
  const auto closed =
      static_cast<int>(std::count(aware.actions.begin(), aware.actions.end(), std::string("slip")));
  const std::string slips = std::to_string(aware.slips) + " slips";
  const std::string answered = std::to_string(closed) + " answered: limit";
  EXPECT_NE(aware.holding.find(closed == aware.slips ? slips + " answered: limit"
                                                     : slips + ", " + answered),
            std::string::npos)
      << aware.holding << "\n"
      << aware.log;
}

TEST(SlipGrasp, LowersItsLimitWhenNothingSlipsAndOpensOnlyWhenTold) {
  HoldingOptions holding;
  holding.noSlipS = 1.0;
  const Pulled quiet = pullTheHandle(GraspMode::kSlip, holding);
  EXPECT_NE(quiet.log.find("lower: nothing slips"), std::string::npos) << quiet.log;
  EXPECT_EQ(quiet.log.find("loosen"), std::string::npos) << quiet.log;
  EXPECT_EQ(quiet.contacts, 2) << quiet.log;
}

TEST(SlipGrasp, LooksForFrictionWhenTheWeightIsGiven) {
  HeldObject held(sceneOf("slipping_handle"));
  GraspRequest request = slipAware("pinch-parallel", 400);
  request.velocityDegPerS = 8.0;
  request.holding.noSlipS = 1.0;
  request.holding.weightN = 0.15 * 9.81;
  request.holding.newtonsPerCount = 0.0007;
  held.begin(request);
  held.run(25.0);
  EXPECT_EQ(held.machine().phase(), GraspPhase::kHolding);
  EXPECT_EQ(held.contacts(), 2);           // it was caught, or never lost
  EXPECT_GE(held.actions("friction"), 2);  // its begin and its result
  const GraspReport& report = held.machine().running();
  for (const GraspStep& note : held.notes()) {
    if (note.text.find("counts in sum") == std::string::npos) continue;
    EXPECT_NE(note.text.find("friction about "), std::string::npos) << note.text;
  }
  if (report.countsAtSlip) {
    ASSERT_TRUE(report.friction.has_value());
    EXPECT_NEAR(*report.friction, 0.15 * 9.81 / (0.0007 * *report.countsAtSlip), 1e-9);
  }
}

TEST(SlipGrasp, EndsWhereItStands) {
  HeldObject held(sceneOf("bottle"));
  GraspRequest request = slipAware("cylindrical", 400);
  request.velocityDegPerS = 8.0;
  held.begin(request);
  ASSERT_TRUE(held.run(8.0, [&] { return held.machine().phase() == GraspPhase::kHolding; }));
  EXPECT_TRUE(held.machine().underTactileControl());
  const std::vector<double> angles = held.hand().joints().angles();
  held.machine().stop(held.us());
  held.run(0.1);
  EXPECT_FALSE(held.machine().active());
  const auto report = held.machine().takeReport();
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->outcome, GraspOutcome::kStopped);
  EXPECT_TRUE(report->held);
  held.run(1.0);
  for (std::size_t axis = 0; axis < angles.size(); ++axis)
    EXPECT_NEAR(held.hand().joints().angles()[axis], angles[axis], 1e-6);
}

// A pad of 3 x 3 taxels on one matrix, held by a slip-aware grasp.
struct HeldPad : testing::MachineBench {
  static constexpr std::int64_t kCycleUs = 5'000;
  int column = 1;
  std::vector<std::string> actions;

  explicit HeldPad(const HoldingOptions& holding = {}) {
    GraspRequest request = slipAware("centrical", 200);
    request.holding = holding;
    begin(request);
    take();
    pad();
    EXPECT_TRUE(takeStop());
    machine.onStopAcknowledged(us);
    for (int i = 0; i < 20; ++i) pad();
    EXPECT_EQ(machine.phase(), GraspPhase::kHolding);
    actions.clear();
  }
  void pad(std::int64_t afterUs = testing::kPeriodUs) {
    us += afterUs;
    TactileFrame felt(sdh2().layout);
    felt.hostUs = 1'700'000'000'000'000 + us;
    felt.matrix(1).block(3, column, 3, 3).setConstant(250.0F);
    machine.onFrame(felt, us);
    machine.onTime(us);
    note();
  }
  // The time goes on without a frame.
  void silence(std::int64_t lastsUs) {
    for (const std::int64_t endUs = us + lastsUs; us < endUs;) {
      us = std::min(us + kCycleUs, endUs);
      machine.onTime(us);
      note();
    }
  }
  void note() {
    for (const GraspStep& note : machine.takeNotes()) actions.push_back(note.action);
  }
  bool commands() { return machine.takeCommand().has_value(); }
};

using Actions = std::vector<std::string>;

// The stream counts as dead after 100 ms.
TEST(SlipGrasp, AHiccupInterruptsTheWatchAndMovesNothing) {
  for (const std::int64_t lastsUs : {105'000, 900'000, 1'000'000}) {
    SCOPED_TRACE(lastsUs);
    HeldPad held;
    held.silence(100'000);
    EXPECT_FALSE(held.machine.unwatchedUs(held.us));
    held.silence(lastsUs - 100'000);
    EXPECT_EQ(held.machine.unwatchedUs(held.us), lastsUs);
    EXPECT_EQ(held.actions, Actions{"interrupted"});
    EXPECT_EQ(held.machine.phase(), GraspPhase::kHolding);
    held.pad(0);
    EXPECT_FALSE(held.machine.unwatchedUs(held.us));
    EXPECT_EQ(held.actions, (Actions{"interrupted", "watched"}));
    for (int i = 0; i < 30; ++i) held.pad();
    EXPECT_EQ(held.machine.phase(), GraspPhase::kHolding);
    EXPECT_FALSE(held.commands());
    // It is watched again.
    ++held.column;
    held.pad();
    EXPECT_EQ(held.machine.phase(), GraspPhase::kClosing);
    EXPECT_TRUE(held.commands());
  }
}

TEST(SlipGrasp, WhatMovedInAHiccupMovesNothing) {
  HeldPad held;
  held.silence(300'000);
  ++held.column;
  held.pad(0);
  for (int i = 0; i < 30; ++i) held.pad();
  EXPECT_EQ(held.machine.phase(), GraspPhase::kHolding);
  EXPECT_FALSE(held.commands());
}

TEST(SlipGrasp, TheTimeOfAHiccupIsNotOneWithoutSlip) {
  HoldingOptions holding;
  holding.noSlipS = 1.0;
  holding.weightN = 1.0;  // opens after noSlipS
  HeldPad held(holding);
  held.silence(900'000);
  held.pad(0);
  for (int i = 0; i < 31; ++i) held.pad();  // 0.98 s
  EXPECT_EQ(held.machine.phase(), GraspPhase::kHolding);
  EXPECT_FALSE(held.commands());
  held.pad();
  EXPECT_EQ(held.machine.phase(), GraspPhase::kLoosening);
}

TEST(SlipGrasp, HiccupsInARowAreEachCounted) {
  HeldPad held;
  Actions each;
  // So many that the usual period of the stream becomes 900 ms.
  for (int i = 0; i < 20; ++i) {
    held.silence(900'000);
    EXPECT_TRUE(held.machine.unwatchedUs(held.us)) << i;
    held.pad(0);
    each.insert(each.end(), {"interrupted", "watched"});
  }
  EXPECT_EQ(held.actions, each);
  EXPECT_EQ(held.machine.phase(), GraspPhase::kHolding);
  EXPECT_FALSE(held.commands());
}

TEST(SlipGrasp, ASilenceOfASecondEndsItWithoutAMotion) {
  HeldPad held;
  held.silence(1'000'000);
  EXPECT_TRUE(held.machine.active());
  held.silence(100'000);
  EXPECT_FALSE(held.machine.active());
  const auto report = held.machine.takeReport();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->outcome, GraspOutcome::kStreamLost);
  EXPECT_TRUE(protectionEnded(*report));
  held.pad(0);
  EXPECT_EQ(held.actions, Actions{"interrupted"});
  EXPECT_FALSE(held.machine.active()) << "it is not held again by itself";
  EXPECT_FALSE(held.commands());
}

// The process itself stood still: only the frames tell of the silence.
TEST(SlipGrasp, ASilenceThatIsFoundAfterwardsCountsAsWell) {
  HeldPad held;
  held.pad(900'000);
  EXPECT_EQ(held.actions, (Actions{"interrupted", "watched"}));
  EXPECT_TRUE(held.machine.active());
  held.pad(1'100'000);
  EXPECT_FALSE(held.machine.active());
  EXPECT_EQ(held.machine.takeReport()->outcome, GraspOutcome::kStreamLost);
  EXPECT_FALSE(held.commands());
}

TEST(SlipGrasp, AStopInAHiccupEndsIt) {
  HeldPad held;
  held.silence(300'000);
  held.machine.stop(held.us);
  EXPECT_FALSE(held.machine.unwatchedUs(held.us));
  EXPECT_TRUE(held.takeStop());
  held.machine.onStopAcknowledged(held.us);
  const auto report = held.machine.takeReport();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->outcome, GraspOutcome::kStopped);
  EXPECT_FALSE(protectionEnded(*report));
  for (int i = 0; i < 10; ++i) held.pad();
  EXPECT_EQ(held.actions, Actions{"interrupted"});
  EXPECT_FALSE(held.machine.active());
  EXPECT_FALSE(held.commands());
}

TEST(SlipGrasp, AnUnpluggedTactilePortEndsItInAHiccup) {
  HeldPad held;
  held.silence(300'000);
  held.machine.onTactilePortGone("unplugged", held.us);
  const auto report = held.machine.takeReport();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->outcome, GraspOutcome::kStreamLost);
  held.pad(0);
  EXPECT_FALSE(held.machine.active());
  EXPECT_FALSE(held.commands());
}

TEST(SlipGrasp, AHiccupWhileItSettlesIsToldAndTheReferencesComeAfterIt) {
  HoldingOptions holding;
  holding.settleS = 0.5;
  HeldPad held(holding);
  ++held.column;
  held.pad();  // slips
  held.take();
  held.pad();
  for (int i = 0; i < 3 && !held.takeStop(); ++i) held.frames(1, 3000.0F);
  held.machine.onStopAcknowledged(held.us);
  ASSERT_EQ(held.machine.phase(), GraspPhase::kSettling);
  held.actions.clear();
  held.silence(300'000);
  EXPECT_EQ(held.machine.unwatchedUs(held.us), 300'000);
  EXPECT_EQ(held.machine.phase(), GraspPhase::kSettling) << "no frame gives a reference";
  held.pad(0);
  held.pad();
  EXPECT_EQ(held.machine.phase(), GraspPhase::kHolding);
  EXPECT_EQ(held.actions, (Actions{"interrupted", "watched"}));
  EXPECT_FALSE(held.commands());
}

TEST(SlipGrasp, HoldsForAsLongAsItWasAsked) {
  HeldObject held(sceneOf("bottle"));
  GraspRequest request = slipAware("cylindrical", 400);
  request.velocityDegPerS = 8.0;
  request.holding.holdS = 2.0;
  held.begin(request);
  ASSERT_TRUE(held.run(12.0, [&] { return !held.machine().active(); }));
  const auto report = held.machine().takeReport();
  EXPECT_EQ(report->outcome, GraspOutcome::kFinished);
  EXPECT_NE(report->text.find("held for 2 s, 0 slips"), std::string::npos) << report->text;
}

// The handle is taken away while the hand closes after it. Runs are the same, so the first one
// tells when that is.
TEST(SlipGrasp, SaysThatItLostWhatItHeld) {
  Scene scene = sceneOf("slipping_handle");
  pull(scene, 8.0, {0.0, 0.0, 12.5}, 6.0);
  GraspRequest request = slipAware("pinch-parallel", 400);
  request.velocityDegPerS = 8.0;
  double closesAgainS = 0.0;
  {
    HeldObject held(scene);
    held.begin(request);
    ASSERT_TRUE(held.run(22.0, [&] {
      return held.machine().running().slips > 0 && held.machine().phase() == GraspPhase::kClosing;
    }));
    closesAgainS = held.timeS();
  }
  MoveObject away;
  away.byMm = {0.0, 0.0, 300.0};
  scene.script.push_back({closesAgainS, away});
  HeldObject held(scene);
  held.begin(request);
  ASSERT_TRUE(held.run(60.0, [&] { return !held.machine().active(); }));
  const auto report = held.machine().takeReport();
  ASSERT_TRUE(report.has_value());
  EXPECT_TRUE(report->held);
  EXPECT_EQ(report->outcome, GraspOutcome::kFinished);
  EXPECT_EQ(report->text, "finished: nothing is held any more");
}

TEST(SlipGrasp, NothingIsThereToHold) {
  HeldObject held(sceneOf("empty"));
  held.begin(slipAware("centrical", 400));
  ASSERT_TRUE(held.run(20.0, [&] { return !held.machine().active(); }));
  EXPECT_EQ(held.machine().takeReport()->outcome, GraspOutcome::kFinished);
}

TEST(SlipGrasp, RefusesWhatItCantDo) {
  GraspRequest request = slipAware("centrical", 400);
  request.holding.maxLimitCounts = 300;
  EXPECT_THROW(request.validate(), std::invalid_argument);
  request = slipAware("centrical", 400);
  request.holding.noSlipS = 0.0;
  EXPECT_THROW(request.validate(), std::invalid_argument);
  // Without a live stream no grasp begins.
  GraspStateMachine machine(sdh2());
  EXPECT_THROW(machine.begin(slipAware("centrical", 400), 1'000'000, 0), DeviceError);
  EXPECT_FALSE(machine.takeCommand().has_value());
}

TEST(SlipGrasp, ItsEventsTellWhatHappened) {
  GraspReport report;
  report.request = slipAware("centrical", 400);
  const Event slip =
      noteEvent(report, {"slip", "slips: finger 0 distal", 1, 700}, 1'400'000'000'000'000);
  EXPECT_EQ(slip.kind, "grasp");
  EXPECT_EQ(slip.matrix, 1);
  EXPECT_EQ(Json::parse(slip.json).at("action").asString(), "slip");
  EXPECT_EQ(Json::parse(slip.json).at("limit_counts").asInteger(), 700);
  report.outcome = GraspOutcome::kFinished;
  report.slips = 3;
  report.limitCounts = 1300;
  const Json end = Json::parse(endEvent(report).json);
  EXPECT_EQ(end.at("mode").asString(), "slip");
  EXPECT_EQ(end.at("slips").asInteger(), 3);
  EXPECT_EQ(end.at("last_limit_counts").asInteger(), 1300);
}

}  // namespace
}  // namespace palpate::slip_grasp_test

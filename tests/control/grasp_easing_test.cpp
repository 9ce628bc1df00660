// A grasp that keeps its limit: the slow part of its approach, the steps after its stop, and what
// ends it meanwhile. grasp_reach_test measures how well the limit is kept.
#include <algorithm>
#include <cmath>

#include "palpate/control/grasp_approach.h"
#include "palpate/device/sdh2.h"
#include "palpate/kinematics/preshape_opening.h"
#include "palpate/model/preshape.h"

#include "control/held_object.h"
#include "control/machine_bench.h"
#include "testing/sdh2.h"
#include "testing/testing.h"

namespace palpate::grasp_easing_test {
namespace {

using testing::HeldObject;

constexpr double kLimit = 200.0;

GraspRequest keeping(GraspMode mode = GraspMode::kReactive) {
  GraspRequest request;
  request.mode = mode;
  request.closeRatio = 1.0;
  request.keepsLimit = true;
  request.object = "ball";
  return request;
}

Scene ballOf(double sizeMm) {
  Scene scene = loadScene("ball", testing::dataFolder() / "scenes");
  scene.script.clear();
  scene.objects.at(0).shape.sizeMm = Eigen::Vector3d::Constant(sizeMm);
  return scene;
}

// What a grasp of the ball of the scene has shown.
Touch touchOfBall() { return {.ratio = 0.82}; }

// A hand that holds the ball, above its limit, and makes its first step.
struct EasingBench {
  HeldObject held{ballOf(70.0)};

  EasingBench() {
    held.begin(keeping(), touchOfBall());
    EXPECT_TRUE(held.run(60.0, [&] { return held.machine().phase() == GraspPhase::kEasing; }));
  }
  double fastestDeg() { return held.hand().joints().angles()[1]; }
};

TEST(GraspEasing, TheVelocityOfTheSlowPartFollowsFromTheLimit) {
  GraspRequest request = keeping();
  const GraspApproach unknown = approachOf(request, {});
  EXPECT_DOUBLE_EQ(slowDegPerS(request, unknown, 200), 200.0 / kSdh2RiseCounts);
  EXPECT_DOUBLE_EQ(slowDegPerS(request, unknown, 1000), 1000.0 / kSdh2RiseCounts);
  EXPECT_DOUBLE_EQ(slowDegPerS(request, unknown, 50), kMinGraspDegPerS);
  EXPECT_DOUBLE_EQ(slowDegPerS(request, approachOf(request, Touch{0.8, 100.0}), 200), 2.0);
  request.velocityDegPerS = 0.5;
  EXPECT_DOUBLE_EQ(slowDegPerS(request, unknown, 1000), 0.5) << "never faster than was asked for";
  request.velocityDegPerS = 10.0;
  request.fingerLimitCounts = {200, 160, 200};
  EXPECT_DOUBLE_EQ(slowDegPerS(request, unknown, 200), 160.0 / kSdh2RiseCounts);
  request.fingerLimitCounts.clear();
  request.limitCounts = 3000;
  request.forceLimitsN = {2.0};
  EXPECT_DOUBLE_EQ(slowDegPerS(request, unknown, 3000), 2.0 / kSdh2RiseN);
}

TEST(GraspEasing, TheSlowPartBeginsBeforeTheTouchThatIsExpected) {
  GraspRequest request = keeping();
  EXPECT_EQ(approachOf(request, {}).fastToRatio, 0.0);
  EXPECT_FALSE(approachOf(request, {}).touchKnown);
  // The fastest joints of the centrical preshape close by 82 deg.
  double largest = 0.0;
  for (const PreshapeJoint& joint : sdh2Preshape("centrical").joints)
    largest = std::max(largest, std::abs(joint.slopeDeg));
  const double margin = kTouchMarginDeg / largest;
  EXPECT_NEAR(approachOf(request, Touch{0.8}).fastToRatio, 0.8 - margin, 1e-12);
  request.touchRatio = 0.6;
  EXPECT_NEAR(approachOf(request, {}).fastToRatio, 0.6 - margin, 1e-12);
  EXPECT_NEAR(approachOf(request, Touch{0.8}).fastToRatio, 0.8 - margin, 1e-12)
      << "where it touched counts more than its size";
}

TEST(GraspEasing, WhatIsToBeExpectedIsSaidBefore) {
  GraspRequest request = keeping();
  const GraspForecast kept = forecastOf(request, Touch{0.8}, {});
  EXPECT_DOUBLE_EQ(kept.counts, 400.0);
  EXPECT_DOUBLE_EQ(kept.timesLimit, kWarnedLimit);
  EXPECT_TRUE(kept.touchKnown);
  // To 1.5 deg before the touch at 10 deg/s, then at 0.25 deg/s.
  EXPECT_NEAR(kept.seconds, (0.8 * 82.0 - 1.5) / 10.0 + 1.5 / 0.25, 0.1);
  EXPECT_NEAR(forecastOf(request, {}, {}).seconds, 82.0 / 0.25, 1.0);
  request.keepsLimit = false;
  EXPECT_DOUBLE_EQ(forecastOf(request, Touch{0.8}, {}).counts, kSdh2StalledCounts);
  request.keepsLimit = true;
  request.limitCounts = 40;
  EXPECT_DOUBLE_EQ(forecastOf(request, {}, {}).timesLimit, (40.0 + 0.2 * kSdh2RiseCounts) / 40.0);
  request.limitCounts = 3000;
  request.forceLimitsN = {2.0};
  EXPECT_DOUBLE_EQ(forecastOf(request, {}, {}).newtons.value(), 4.0);
}

TEST(GraspEasing, TheCloseRatioOfAngles) {
  const Preshape& preshape = sdh2Preshape("centrical");
  for (const double ratio : {0.0, 0.37, 1.0})
    EXPECT_NEAR(closeRatioOf(preshape, preshape.anglesDeg(ratio)).value(), ratio, 1e-12);
  EXPECT_FALSE(closeRatioOf(preshape, {1.0, 2.0}));
}

TEST(GraspEasing, APersonsStopLeavesTheFingersWhereTheyAre) {
  EasingBench bench;
  bench.held.machine().stop(bench.held.us());
  bench.held.run(0.1);
  const auto report = bench.held.machine().takeReport();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->outcome, GraspOutcome::kStopped);
  EXPECT_NE(report->text.find(" times the limit"), std::string::npos) << report->text;
  const std::vector<double> angles = bench.held.hand().joints().angles();
  bench.held.run(2.0);
  EXPECT_EQ(bench.held.hand().joints().angles(), angles);
}

TEST(GraspEasing, EndsWhereItStandsWithoutTactileFrames) {
  EasingBench bench;
  GraspStateMachine& machine = bench.held.machine();
  machine.takeCommand();
  for (int ms = 0; ms < 500; ms += 5) {
    machine.onTime(bench.held.us() + ms * 1000);
    if (const auto command = machine.takeCommand()) {
      EXPECT_TRUE(std::holds_alternative<StopMotion>(*command));
      machine.onStopAcknowledged(bench.held.us() + ms * 1000);
    }
  }
  const auto report = machine.takeReport();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->outcome, GraspOutcome::kStreamLost) << report->text;
}

TEST(GraspEasing, EndsWhereItStandsWhenTheTactilePortIsUnplugged) {
  EasingBench bench;
  bench.held.machine().onTactilePortGone("unplugged", bench.held.us());
  bench.held.run(0.1);
  const auto report = bench.held.machine().takeReport();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->outcome, GraspOutcome::kStreamLost);
  EXPECT_NE(report->text.find("perhaps above its limit"), std::string::npos) << report->text;
}

TEST(GraspEasing, ItOpensWhileTheReadingIsAboveTheLimit) {
  EasingBench bench;
  const double before = bench.fastestDeg();
  // Only readings above the limit, whatever the hand does.
  GraspStateMachine& machine = bench.held.machine();
  TactileFrame frame(sdh2().layout);
  frame.matrix(1)(7, 2) = 500.0F;
  std::int64_t us = bench.held.us();
  std::vector<double> present = bench.held.hand().joints().angles();
  const std::vector<double> closed = sdh2Preshape("centrical").anglesDeg(1.0);
  int steps = 0;
  for (int i = 0; i < 400; ++i) {
    us += 31'500;
    frame.hostUs = 1'700'000'000'000'000 + us;
    machine.onAngles(present, us);
    machine.onFrame(frame, us);
    machine.onTime(us);
    while (const auto command = machine.takeCommand()) {
      const auto* move = std::get_if<MoveJoints>(&*command);
      if (!move) {
        machine.onStopAcknowledged(us);
        continue;
      }
      ++steps;
      for (std::size_t axis = 0; axis < present.size(); ++axis)
        EXPECT_LE(std::abs(closed[axis] - present[axis]),
                  std::abs(closed[axis] - move->targetDeg[axis]) + 1e-9)
            << "axis " << axis << " closes";
      present = move->targetDeg;
      machine.onMoveAcknowledged(0.01, us);
      us += 31'500;
      machine.onAxisStates(std::vector<int>(present.size(), 0), us);
    }
  }
  EXPECT_GT(steps, 3);
  EXPECT_NE(present[1], before);
}

// A soft object that is larger than the one that was remembered.
TEST(GraspEasing, ATouchBeforeItWasExpectedEndsTheFastPart) {
  Scene scene = ballOf(90.0);
  scene.objects.at(0).stiffnessNPerMm3 = 0.01;
  HeldObject held(scene);
  held.begin(keeping(), touchOfBall());
  ASSERT_TRUE(held.run(120.0, [&] { return !held.machine().active(); }));
  EXPECT_EQ(held.actions("touch"), 1);
  EXPECT_LT(held.machine().running().touch.value().ratio, 0.8);
}

// A hard object, larger than the one that was remembered: its limit is reached in the fast part.
// When it slips then, the hand closes slowly, though it is still before the expected touch.
TEST(GraspEasing, NothingIsFastAfterTheLimit) {
  Scene scene = ballOf(85.0);
  scene.script = {{60.0, LoadObject{.object = 0, .forceN = {0.0, 0.0, -8.0}, .durationS = 0.5}}};
  HeldObject held(scene);
  GraspRequest request = keeping(GraspMode::kSlip);
  request.limitCounts = 30;
  request.velocityDegPerS = 100.0;
  held.begin(request, touchOfBall());
  ASSERT_TRUE(held.run(50.0, [&] { return held.machine().phase() == GraspPhase::kHolding; }));
  ASSERT_EQ(held.actions("touch"), 0);
  const std::size_t before = held.moves().size();
  ASSERT_TRUE(held.run(60.0, [&] { return held.moves().size() > before; })) << "it slips";
  const MoveJoints& answer = held.moves()[before];
  EXPECT_LE(*std::max_element(answer.velocityDegPerS.begin(), answer.velocityDegPerS.end()), 5.0)
      << "not at the 100 deg/s of the fast part";
}

// A joint is blocked by a touch that is too light to end the fast part. When the hand closes again,
// it does so slowly, though it is still before the expected touch.
TEST(GraspEasing, NothingIsFastAfterAJointWasBlocked) {
  testing::MachineBench bench;
  bench.machine.onAngles(sdh2Preshape("centrical").anglesDeg(0.0), bench.us);
  GraspRequest request = keeping(GraspMode::kSlip);
  request.preshape = "centrical";
  request.velocityDegPerS = 100.0;
  request.holding.weightN = 1.0;
  request.holding.newtonsPerCount = 0.001;
  bench.machine.begin(request, bench.us, 42, touchOfBall());
  std::optional<MoveJoints> last;
  double fastest = 0.0;
  for (int i = 0;
       i < 800 && !(fastest > 50.0 && last && bench.machine.phase() == GraspPhase::kIdle);
       ++i) {
    bench.frames(1, 3.0F);
    bench.machine.onTime(bench.us);
    while (const auto command = bench.machine.takeCommand()) {
      if (std::holds_alternative<StopMotion>(*command)) {
        bench.machine.onStopAcknowledged(bench.us);
        continue;
      }
      const auto& move = std::get<MoveJoints>(*command);
      const double velocity =
          *std::max_element(move.velocityDegPerS.begin(), move.velocityDegPerS.end());
      if (fastest > 50.0) last = move;
      fastest = std::max(fastest, velocity);
      bench.machine.onMoveAcknowledged(2.0, bench.us);
      if (bench.machine.phase() == GraspPhase::kClosing && velocity > 50.0) {
        ASSERT_FALSE(last) << "the fast part again";
        bench.frames(2, 3.0F);
        bench.machine.onAxisStates(testing::kMoving, bench.us);
        bench.machine.onAxisStates(testing::kHeld, bench.us);
      }
    }
  }
  EXPECT_GT(fastest, 50.0);
  ASSERT_TRUE(last) << "the friction test closes again";
}

// Smaller than the rise that counts as a touch.
TEST(GraspEasing, ALimitOfAFewCountsIsHeld) {
  HeldObject held(ballOf(70.0));
  GraspRequest request = keeping();
  request.limitCounts = 8;
  held.begin(request, touchOfBall());
  ASSERT_TRUE(held.run(120.0, [&] { return !held.machine().active(); }));
  const auto report = held.machine().takeReport();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->outcome == GraspOutcome::kLimitReached, held.machine().peak().counts > 0.0F)
      << report->text;
}

TEST(GraspEasing, ASlipAwareGraspHoldsAfterIt) {
  HeldObject held(ballOf(70.0));
  held.begin(keeping(GraspMode::kSlip), touchOfBall());
  ASSERT_TRUE(held.run(60.0, [&] { return held.machine().phase() == GraspPhase::kHolding; }));
  const double times = static_cast<double>(held.machine().peak().counts) / kLimit;
  EXPECT_GE(times, kKeptFromLimit);
  EXPECT_LE(times, kKeptToLimit);
}

// Wherever along the fingers the object is: the ball of the scene is between their tips, which
// touch it later than the proximal pads would.
TEST(GraspEasing, TheSizeOfTheObjectTellsWhereItTouchesAtTheEarliest) {
  const HandGeometry geometry(sdh2Geometry());
  for (const double sizeMm : {60.0, 70.0, 80.0}) {
    GraspRequest request = keeping();
    request.limitCounts = 1000;
    request.touchRatio = touchRatioOf(geometry, sdh2Preshape("centrical"), sizeMm);
    HeldObject held(ballOf(sizeMm));
    held.begin(request);
    ASSERT_TRUE(held.run(120.0, [&] { return !held.machine().active(); }));
    ASSERT_TRUE(held.machine().running().touch) << sizeMm;
    EXPECT_GE(held.machine().running().touch->ratio, request.touchRatio.value()) << sizeMm;
    EXPECT_EQ(held.actions("touch"), 0) << sizeMm << ": not in the fast part";
  }
}

TEST(TouchMemory, RemembersTheEarlierTouchAndTheLargerRiseAtOnce) {
  TouchMemory memory;
  GraspReport report;
  report.request = keeping();
  report.touch = Touch{0.8, 400.0};
  EXPECT_TRUE(memory.learn(report));
  report.touch = Touch{0.7, 600.0};
  EXPECT_TRUE(memory.learn(report));
  EXPECT_DOUBLE_EQ(memory.find("centrical", "ball")->ratio, 0.7);
  EXPECT_DOUBLE_EQ(*memory.find("centrical", "ball")->riseCounts, 600.0);
  EXPECT_EQ(memory.find("centrical", "ball")->grasps, 2);
  // A later touch, or a smaller rise, changes it by half.
  report.touch = Touch{0.8, 400.0};
  EXPECT_TRUE(memory.learn(report));
  EXPECT_DOUBLE_EQ(memory.find("centrical", "ball")->ratio, 0.75);
  EXPECT_DOUBLE_EQ(*memory.find("centrical", "ball")->riseCounts, 500.0);
  EXPECT_FALSE(memory.find("spherical", "ball"));
  EXPECT_FALSE(memory.find("centrical", "pen"));
  report.request.object.clear();
  EXPECT_FALSE(memory.learn(report)) << "nothing is remembered of an object without a name";
  EXPECT_TRUE(memory.forget("centrical", "ball"));
  EXPECT_TRUE(memory.empty());
}

TEST(TouchMemory, IsWrittenAndReadBack) {
  TouchMemory memory;
  GraspReport report;
  report.request = keeping();
  report.request.object = "ball \"7\", süß";
  report.touch = Touch{0.8125, 400.5, {}, 1};
  memory.learn(report);
  const TouchMemory read = TouchMemory::parse(memory.text(), "touches.json");
  const Touch touch = read.find("centrical", report.request.object).value();
  EXPECT_EQ(touch.ratio, 0.8125);
  EXPECT_EQ(touch.riseCounts, 400.5);
  EXPECT_FALSE(touch.riseN);
  EXPECT_EQ(touch.grasps, 1);
}

TEST(TouchMemory, RefusesWhatIsNoSuchFile) {
  for (
      const char* text :
      {"",
       "{}",
       "[1]",
       R"({"format":"palpate-poses","version":1,"touches":[]})",
       R"({"format":"palpate-touches","version":2,"touches":[]})",
       R"({"format":"palpate-touches","version":1,"touches":[{"preshape":"a","object":"","ratio":0.5,"grasps":1}]})",
       R"({"format":"palpate-touches","version":1,"touches":[{"preshape":"a","object":"b","ratio":1.5,"grasps":1}]})",
       R"({"format":"palpate-touches","version":1,"touches":[{"preshape":"a","object":"b","ratio":0.5,"grasps":0}]})"})
    EXPECT_THROW(TouchMemory::parse(text, "touches.json"), Error) << text;
}

}  // namespace
}  // namespace palpate::grasp_easing_test

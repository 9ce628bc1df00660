// L-M14: the rise of the reading after the stop of a grasp is measured and reported. The emulated
// ball is hard, and the rubber has a lag of 0.16 s, so the rise depends on the velocity.
#include <algorithm>
#include <cstdio>
#include <random>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

#include "control/held_object.h"
#include "testing/testing.h"

namespace palpate::grasp_reach_test {
namespace {

using testing::HeldObject;

struct Reach {
  GraspReport report;
  // Largest reading of a taxel from the stop to a second later, as the test received it [counts].
  double largest = 0.0;
};

// Runs one grasp. A slightly larger velocity changes the time of the frames relative to the touch.
Reach reachOf(const std::string& scene, double velocity, int limit, double hair = 0.0) {
  Scene loaded = loadScene(scene, testing::dataFolder() / "scenes");
  loaded.script.clear();
  HeldObject held(loaded);
  GraspRequest request;
  request.mode = GraspMode::kReactive;
  request.closeRatio = 1.0;
  request.velocityDegPerS = velocity * (1.0 + hair);
  request.limitCounts = limit;
  held.begin(request);
  Reach reach;
  EXPECT_TRUE(held.run(200.0, [&] { return held.machine().phase() == GraspPhase::kSettling; }));
  reach.largest = static_cast<double>(held.machine().peak().counts);
  held.run(0.5, [&] {
    reach.largest = std::max(reach.largest, static_cast<double>(held.machine().peak().counts));
    return false;
  });
  if (auto report = held.machine().takeReport()) reach.report = *report;
  return reach;
}

TEST(GraspReach, WhatIsReachedAfterTheStopIsInTheReport) {
  const Reach reach = reachOf("ball", 10.0, 200);
  EXPECT_EQ(reach.report.outcome, GraspOutcome::kLimitReached);
  ASSERT_TRUE(reach.report.peakAfterStop.has_value());
  EXPECT_NEAR(static_cast<double>(reach.report.peakAfterStop->counts), reach.largest, 50.0);
  EXPECT_GT(reach.largest, 1000.0) << "the ball is hard";
  EXPECT_NE(reach.report.text.find("after the stop"), std::string::npos) << reach.report.text;
  EXPECT_NE(reach.report.text.find("close more slowly"), std::string::npos) << reach.report.text;
  const Json json = Json::parse(endEvent(reach.report).json);
  EXPECT_EQ(json.at("reached_counts").asDouble(),
            static_cast<double>(reach.report.peakAfterStop->counts));
  EXPECT_EQ(json.at("limit_counts").asInteger(), 200);
}

TEST(GraspReach, WhatDoesNotRiseIsNotTalkedAbout) {
  const Reach reach = reachOf("pen", 2.0, 1000);
  EXPECT_EQ(reach.report.outcome, GraspOutcome::kLimitReached);
  EXPECT_EQ(reach.report.text.find("close more slowly"), std::string::npos) << reach.report.text;
}

// docs/notes/safety.md contains these figures: scripts/measure reads `measured {..}`. The rise is
// smaller at a lower velocity.
TEST(GraspReach, TheSlowerTheLess) {
  // Different times of the frames relative to the touch.
  constexpr int kTouches = 7;
  const auto reached = [](double velocity, int limit) {
    std::vector<double> largest;
    for (int i = 0; i < kTouches; ++i)
      largest.push_back(reachOf("ball", velocity, limit, 0.0007 * i).largest);
    std::sort(largest.begin(), largest.end());
    const double median = largest[kTouches / 2];
    const std::string name =
        "reach_" + numberText(velocity) + "_deg_per_s_limit_" + std::to_string(limit);
    const Json line = Json::object()
                          .set("name", name)
                          .set("median_counts", median)
                          .set("worst_counts", largest.back())
                          .set("worst_times", largest.back() / limit);
    std::printf("measured %s\n", line.text(-1).c_str());
    return median;
  };
  for (const int limit : {200, 1000, 2000})
    EXPECT_LE(reached(2.0, limit), 1.02 * reached(10.0, limit));
}

// One grasp that keeps its limit, at the usual values, of the object of a scene.
struct KeptGrasp {
  GraspReport report;
  double seconds = 0.0;
  double peak = 0.0;    // largest reading until a second after the end [counts]
  double atRest = 0.0;  // a second after the end [counts]
  int contacts = 0;     // matrices that touch then
};

// `offsetMm`: of the object's place; `waitS`: changes the time of the frames relative to the touch.
KeptGrasp keptGrasp(const std::string& scene,
                    const Eigen::Vector3d& offsetMm,
                    double waitS,
                    bool keepsLimit,
                    TouchMemory& memory) {
  Scene loaded = loadScene(scene, testing::dataFolder() / "scenes");
  loaded.script.clear();
  loaded.objects.at(0).positionMm += offsetMm;
  HeldObject held(loaded);
  held.run(waitS);
  GraspRequest request;
  request.mode = GraspMode::kReactive;
  request.preshape = loaded.preshape;
  request.closeRatio = 1.0;
  request.keepsLimit = keepsLimit;
  request.object = scene;
  const double beginS = held.timeS();
  KeptGrasp grasp;
  const auto look = [&] {
    grasp.peak = std::max(grasp.peak, static_cast<double>(held.machine().peak().counts));
    return !held.machine().active();
  };
  held.begin(request, memory.find(request.preshape, scene));
  EXPECT_TRUE(held.run(1000.0, look));
  grasp.seconds = held.timeS() - beginS;
  grasp.report = held.machine().takeReport().value();
  memory.learn(grasp.report);
  held.run(1.0, [&] {
    look();
    return false;
  });
  grasp.atRest = static_cast<double>(held.machine().peak().counts);
  grasp.contacts = held.contacts();
  return grasp;
}

// The objects of the scenes, up to 2 mm from their places in each direction, at random phases of
// the frames. Grasps of an object learn from those before, the first one knows nothing.
// docs/notes/safety.md contains these figures.
TEST(GraspReach, AGraspThatKeepsItsLimit) {
  constexpr int kGrasps = 15;
  constexpr double kLimit = 200.0;  // the usual one
  for (const char* scene : {"ball", "foam_ball", "bottle"}) {
    std::mt19937 random(20261127);
    std::uniform_real_distribution<double> place(-2.0, 2.0), phase(0.0, HeldObject::kPeriodS);
    TouchMemory memory, nothing;
    std::vector<double> peaks, peaksBefore, rests, seconds, secondsBefore;
    int dropped = 0, kept = 0;
    double firstS = 0.0, firstPeak = 0.0;
    for (int i = 0; i < kGrasps; ++i) {
      const Eigen::Vector3d offset(place(random), place(random), place(random));
      const double waitS = phase(random);
      const KeptGrasp now = keptGrasp(scene, offset, waitS, true, memory);
      const KeptGrasp before = keptGrasp(scene, offset, waitS, false, nothing);
      const auto times = now.atRest / kLimit;
      kept += times >= kKeptFromLimit && times <= kKeptToLimit ? 1 : 0;
      dropped += now.atRest == 0.0 || now.contacts < 2 ? 1 : 0;
      rests.push_back(times);
      peaksBefore.push_back(before.peak / kLimit);
      secondsBefore.push_back(before.seconds);
      if (i == 0) {
        firstS = now.seconds;
        firstPeak = now.peak / kLimit;
      } else {
        peaks.push_back(now.peak / kLimit);
        seconds.push_back(now.seconds);
      }
      EXPECT_EQ(now.report.outcome, GraspOutcome::kLimitReached) << now.report.text;
      EXPECT_GE(times, kKeptFromLimit) << scene << ' ' << i << ": " << now.report.text;
      EXPECT_LE(times, kKeptToLimit) << scene << ' ' << i << ": " << now.report.text;
      EXPECT_LE(now.peak, 3.0 * kLimit) << scene << ' ' << i << ": " << now.report.text;
      EXPECT_GE(now.contacts, 2) << scene << ' ' << i;
    }
    for (auto* list : {&peaks, &peaksBefore, &rests, &seconds, &secondsBefore})
      std::sort(list->begin(), list->end());
    const Json line = Json::object()
                          .set("name", std::string("kept_") + scene)
                          .set("grasps", kGrasps)
                          .set("kept", kept)
                          .set("dropped", dropped)
                          .set("rest_min_times", rests.front())
                          .set("rest_max_times", rests.back())
                          .set("first_s", firstS)
                          .set("first_peak_times", firstPeak)
                          .set("peak_median_times", peaks[peaks.size() / 2])
                          .set("peak_worst_times", peaks.back())
                          .set("median_s", seconds[seconds.size() / 2])
                          .set("worst_s", seconds.back())
                          .set("before_peak_median_times", peaksBefore[kGrasps / 2])
                          .set("before_peak_worst_times", peaksBefore.back())
                          .set("before_median_s", secondsBefore[kGrasps / 2]);
    std::printf("measured %s\n", line.text(-1).c_str());
    EXPECT_LE(seconds[seconds.size() / 2], 3.0 * secondsBefore[kGrasps / 2]) << scene;
  }
}

TEST(GraspReach, NothingIsDroppedInAHundredGrasps) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-2.0, 2.0), phase(0.0, HeldObject::kPeriodS);
  for (const char* scene : {"ball", "foam_ball", "bottle", "box"}) {
    TouchMemory memory;
    for (int i = 0; i < 25; ++i) {
      const Eigen::Vector3d offset(place(random), place(random), place(random));
      const KeptGrasp grasp = keptGrasp(scene, offset, phase(random), true, memory);
      EXPECT_GE(grasp.contacts, 2) << scene << ' ' << i << ": " << grasp.report.text;
      EXPECT_GT(grasp.atRest, 0.0) << scene << ' ' << i << ": " << grasp.report.text;
    }
  }
}

}  // namespace
}  // namespace palpate::grasp_reach_test

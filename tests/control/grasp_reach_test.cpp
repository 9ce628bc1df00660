// L-M14: the rise of the reading after the stop of a grasp is measured and reported. The emulated
// ball is hard, and the rubber has a lag of 0.16 s, so the rise depends on the velocity.
#include <algorithm>
#include <cstdio>

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

// docs/safety.md contains these figures: scripts/measure reads `measured {..}`. The rise is smaller
// at a lower velocity.
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

}  // namespace
}  // namespace palpate::grasp_reach_test

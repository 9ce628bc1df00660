#include "palpate/recognition/grasp_collector.h"

#include <stdexcept>

#include "palpate/device/sdh2.h"

#include "recognition/pinch_profile.h"
#include "testing/testing.h"

namespace palpate::grasp_collector_test {
namespace {

using testing::pinchProfile;
using testing::PinchStep;

// Feeds a profile as a device does: the joint angles of a frame come before it.
void feed(const Profile& profile, GraspCollector& collector) {
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    collector.addAngles(profile.angles(i));
    collector.addFrame(std::make_shared<const TactileFrame>(profile.frame(i)));
  }
}

std::vector<PinchStep> steps(std::initializer_list<std::pair<int, bool>> parts) {
  std::vector<PinchStep> all;
  for (const auto& [count, contact] : parts)
    all.insert(all.end(),
               static_cast<std::size_t>(count),
               contact ? PinchStep{30.0, 900.0F, 300.0F} : PinchStep{50.0});
  return all;
}

TEST(GraspCollector, KeepsAGraspWithALittleBeforeAndAfterIt) {
  GraspCollector collector(sdh2());
  const Profile all = pinchProfile(steps({{50, false}, {60, true}, {50, false}}));
  feed(all, collector);
  const auto ended = collector.takeEnded();
  ASSERT_EQ(ended.size(), 1u);
  EXPECT_EQ(ended[0].numFrames(), 16u + 60u + 10u);
  EXPECT_EQ(ended[0].frameTimeUs(0), all.frameTimeUs(50 - 16));
  EXPECT_EQ(ended[0].frame(16).values, all.frame(50).values);
  EXPECT_EQ(ended[0].anglesAtFrame(20)->values, all.anglesAtFrame(54)->values);
  EXPECT_FALSE(collector.touched());
  EXPECT_FALSE(collector.now());
  EXPECT_TRUE(collector.takeEnded().empty()) << "once";
  // The features are those of the grasp in the whole recording.
  const ChosenGrasp clip = graspOf(ended[0], FeatureSet::kBest);
  const ChosenGrasp whole = graspWithin(all, 0, all.numFrames() - 1, FeatureSet::kBest);
  ASSERT_EQ(clip.features.problem, "");
  EXPECT_EQ(clip.features.values, whole.features.values);
  EXPECT_EQ(clip.timeUs, all.frameTimeUs(50));
  EXPECT_EQ(whole.features.begin, 50u);
}

TEST(GraspCollector, KeepsNoMoreOfAContactThatNeverEnds) {
  GraspCollectorOptions options;
  options.maxFrames = 100;
  GraspCollector collector(sdh2(), options);
  // Joint angles come three times as often as frames, as with a real hand.
  const Profile held = pinchProfile(steps({{1, true}}));
  std::size_t keptAngles = 0;
  for (int i = 0; i < 20'000; ++i) {
    for (int k = 0; k < 3; ++k) {
      Sample angles = held.angles(0);
      angles.hostUs = 1'000'000 + i * 32'000LL + k * 10'000LL;
      collector.addAngles(std::move(angles));
    }
    TactileFrame frame = held.frame(0);
    frame.hostUs = 1'000'000 + i * 32'000LL + 25'000;
    collector.addFrame(std::make_shared<const TactileFrame>(std::move(frame)));
    if (i == 200) keptAngles = collector.keptAngles();
  }
  EXPECT_LE(collector.keptFrames(), 100u + 16u);
  EXPECT_LE(collector.keptAngles(), 3u * 100u + 3u);
  EXPECT_EQ(collector.keptAngles(), keptAngles);
  // The angles of the kept frames are all there.
  ASSERT_TRUE(collector.now());
  EXPECT_EQ(collector.now()->numFrames(), 100u);
  EXPECT_GE(collector.now()->numAngles(), 300u);
}

TEST(GraspCollector, TellsWhatIsHeldNow) {
  GraspCollector collector(sdh2());
  feed(pinchProfile(steps({{30, false}, {20, true}})), collector);
  EXPECT_TRUE(collector.touched());
  EXPECT_FALSE(collector.now()) << "20 frames are no grasp yet";
  collector.reset();
  EXPECT_FALSE(collector.touched());
  feed(pinchProfile(steps({{30, false}, {40, true}})), collector);
  EXPECT_NEAR(collector.touchedS(), 39 * 0.032, 1e-9);
  ASSERT_TRUE(collector.now());
  EXPECT_EQ(collector.now()->numFrames(), 16u + 40u);
  EXPECT_TRUE(collector.takeEnded().empty());
}

TEST(GraspCollector, BridgesThreeFramesAndNoMore) {
  GraspCollector collector(sdh2());
  feed(pinchProfile(steps({{5, false}, {30, true}, {3, false}, {30, true}, {20, false}})),
       collector);
  auto ended = collector.takeEnded();
  ASSERT_EQ(ended.size(), 1u);
  EXPECT_EQ(ended[0].numFrames(), 5u + 63u + 10u);
  collector.reset();
  feed(pinchProfile(steps({{5, false}, {30, true}, {6, false}, {30, true}, {20, false}})),
       collector);
  ended = collector.takeEnded();
  ASSERT_EQ(ended.size(), 2u);
  EXPECT_EQ(ended[0].numFrames(), 5u + 30u + 6u);
  EXPECT_EQ(graspOf(ended[1], FeatureSet::kBest).features.problem, "");
}

TEST(GraspCollector, ATouchIsNoGrasp) {
  GraspCollector collector(sdh2());
  feed(pinchProfile(steps({{30, false}, {20, true}, {30, false}})), collector);
  EXPECT_TRUE(collector.takeEnded().empty());
  // One finger alone.
  std::vector<PinchStep> one(60, PinchStep{30.0, 900.0F, 0.0F});
  collector.reset();
  feed(pinchProfile(one), collector);
  EXPECT_FALSE(collector.touched());
}

TEST(GraspCollector, AGapEndsAGrasp) {
  GraspCollector collector(sdh2());
  const Profile held = pinchProfile(steps({{10, false}, {60, true}}));
  feed(held, collector);
  TactileFrame late = held.frame(69);
  late.hostUs += 5'000'000;
  collector.addFrame(std::make_shared<const TactileFrame>(late));
  const auto ended = collector.takeEnded();
  ASSERT_EQ(ended.size(), 1u);
  EXPECT_EQ(ended[0].numFrames(), 70u);
  EXPECT_EQ(collector.touchedS(), 0.0) << "it begins anew";
}

TEST(GraspCollector, FramesThatDoNotFitAreLeftOut) {
  GraspCollector collector(sdh2());
  collector.addFrame(nullptr);
  collector.addFrame(std::make_shared<const TactileFrame>(testing::otherSensorProfile(1).frame(0)));
  EXPECT_FALSE(collector.touched());
  const Profile held = pinchProfile(steps({{40, true}}));
  feed(held, collector);
  // The same frames again are ignored, because they are not later.
  feed(held, collector);
  EXPECT_EQ(collector.now()->numFrames(), 40u);
  GraspCollectorOptions few;
  few.maxFrames = 30;
  GraspCollector bounded(sdh2(), few);
  feed(held, bounded);
  EXPECT_EQ(bounded.now()->numFrames(), 30u);
  few.maxFrames = 5;
  EXPECT_THROW(GraspCollector(sdh2(), few), std::invalid_argument);
}

TEST(ChosenGrasp, IsTheLongestOneWithinTheFrames) {
  const Profile all =
      pinchProfile(steps({{20, false}, {30, true}, {20, false}, {60, true}, {20, false}}));
  EXPECT_EQ(graspOf(all, FeatureSet::kBest).features.begin, 70u);
  EXPECT_EQ(graspWithin(all, 0, 60, FeatureSet::kBest).features.begin, 20u);
  const ChosenGrasp part = graspWithin(all, 80, 149, FeatureSet::kBest);
  EXPECT_EQ(part.features.begin, 80u) << "cut to what was chosen";
  EXPECT_EQ(part.features.end, 129u);
  EXPECT_NE(graspWithin(all, 0, 10, FeatureSet::kBest).features.problem.find("no grasp"),
            std::string::npos);
  EXPECT_NE(graspOf(testing::otherSensorProfile(30), FeatureSet::kBest).features.problem, "");
  EXPECT_EQ(graspOf(pinchProfile({}), FeatureSet::kBest).features.problem, "no frame");
  EXPECT_THROW(graspWithin(all, 0, 150, FeatureSet::kBest), std::out_of_range);
}

}  // namespace
}  // namespace palpate::grasp_collector_test

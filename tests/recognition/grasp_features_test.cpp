#include "palpate/recognition/grasp_features.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recognition/plateau_features.h"
#include "palpate/recognition/study_features.h"

#include "recognition/pinch_profile.h"
#include "testing/sdh2.h"

namespace palpate::grasp_features_test {
namespace {

using testing::pinchProfile;
using testing::PinchStep;

constexpr FeatureSet kSets[] = {FeatureSet::kStudy, FeatureSet::kBest, FeatureSet::kSession};

// Two grasps of 30 frames with 10 empty frames before, between and after them.
Profile twoGrasps() {
  std::vector<PinchStep> steps(10, {60.0});
  for (int grasp = 0; grasp < 2; ++grasp) {
    steps.insert(steps.end(), 30, {50.0 - 10.0 * grasp, 1000.0F, 400.0F});
    steps.insert(steps.end(), 10, {60.0});
  }
  return pinchProfile(steps);
}

TEST(GraspFeatures, SetsHaveNames) {
  for (const FeatureSet set : kSets) {
    EXPECT_EQ(featureSetNamed(featureSetName(set)), set);
    const auto names = featureNames(set, sdh2());
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size())
        << "each once";
  }
  EXPECT_FALSE(featureSetNamed("everything").has_value());
  EXPECT_EQ(featureNames(FeatureSet::kStudy, sdh2()), studyFeatureNames(sdh2PinchHand()));
  EXPECT_EQ(featureNames(FeatureSet::kBest, sdh2()), plateauFeatureNames());
  const auto session = featureNames(FeatureSet::kSession, sdh2());
  EXPECT_TRUE(
      std::equal(plateauFeatureNames().begin(), plateauFeatureNames().end(), session.begin()));
  for (const char* angle : {"angle_1", "angle_2", "angle_5", "angle_6"})
    EXPECT_EQ(std::count(session.begin(), session.end(), angle), 1);
  EXPECT_NE(sessionSetWarning().find("remembers the pose"), std::string_view::npos);
}

// Units by the headers of the sets: plateau_features.h, study_features.h, contact_statistics.h.
TEST(GraspFeatures, HaveUnits) {
  EXPECT_EQ(featureUnit(FeatureSet::kBest, "size_z"), "") << "40 ln(1 + D / 40)";
  EXPECT_EQ(featureUnit(FeatureSet::kSession, "closing_mm"), "mm");
  EXPECT_EQ(featureUnit(FeatureSet::kBest, "ln_sum"), "");
  EXPECT_EQ(featureUnit(FeatureSet::kSession, "angle_5"), "deg");
  EXPECT_EQ(featureUnit(FeatureSet::kSession, "m1_row"), "taxels");
  EXPECT_EQ(featureUnit(FeatureSet::kStatistics, "m1_row"), "") << "from -1 to 1";
  EXPECT_EQ(featureUnit(FeatureSet::kStudy, "diameter"), "mm");
  EXPECT_EQ(featureUnit(FeatureSet::kStudy, "std_5"), "full scale");
  EXPECT_EQ(featureUnit(FeatureSet::kStudy, "m1_T00"), "");
  EXPECT_EQ(featureMeaning(FeatureSet::kStudy, "m1_T02"),
            "Chebyshev moment of order 0 along x, 2 along y, matrix 1");
  EXPECT_EQ(featureMeaning(FeatureSet::kSession, "angle_5"),
            "angle of axis 5, median over the plateau");
  EXPECT_EQ(featureMeaning(FeatureSet::kBest, "other"), "");
  for (const FeatureSet set :
       {FeatureSet::kStudy, FeatureSet::kBest, FeatureSet::kSession, FeatureSet::kStatistics})
    for (const std::string& name : featureNames(set, sdh2()))
      EXPECT_NE(featureMeaning(set, name), "") << name;
}

TEST(GraspFeatures, KeepTheQualityOfTheGrasp) {
  const Profile profile = twoGrasps();
  const auto grasps = findPinches(profile, FeatureSet::kBest);
  const auto found = recordingFeatures(profile, FeatureSet::kBest);
  ASSERT_EQ(found.grasps.size(), grasps.size());
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    EXPECT_EQ(found.grasps[i].quality, grasps[i].quality);
    EXPECT_GT(found.grasps[i].quality, 0.5) << "held steadily";
  }
}

TEST(GraspFeatures, EveryGraspOfARecordingHasARow) {
  const Profile profile = twoGrasps();
  for (const FeatureSet set : kSets) {
    const RecordingFeatures found = recordingFeatures(profile, set);
    EXPECT_EQ(found.problem, "");
    ASSERT_EQ(found.grasps.size(), 2u);
    EXPECT_EQ(found.grasps[0].begin, 10u);
    EXPECT_EQ(found.grasps[0].end, 39u);
    EXPECT_EQ(found.grasps[1].begin, 50u);
    for (const GraspFeatures& grasp : found.grasps) {
      EXPECT_EQ(grasp.problem, "");
      EXPECT_EQ(grasp.values.size(), featureNames(set, sdh2()).size());
      EXPECT_TRUE(std::all_of(
          grasp.values.begin(), grasp.values.end(), [](double v) { return std::isfinite(v); }));
      EXPECT_GE(grasp.initialFrame, grasp.begin);
      EXPECT_LE(grasp.endFrame, grasp.end);
    }
    EXPECT_EQ(graspFeatures(profile, {.begin = 50, .end = 79, .fingers = {}, .quality = 1.0}, set),
              found.grasps[1]);
  }
}

TEST(GraspFeatures, OfASessionHoldTheAnglesAtRest) {
  const Profile profile = twoGrasps();
  const auto names = featureNames(FeatureSet::kSession, sdh2());
  const auto at =
      static_cast<std::size_t>(std::find(names.begin(), names.end(), "angle_1") - names.begin());
  const auto found = recordingFeatures(profile, FeatureSet::kSession);
  EXPECT_EQ(found.grasps[0].values[at], testing::anglesForGap(50.0)[1]);
  EXPECT_EQ(found.grasps[1].values[at + 3], testing::anglesForGap(40.0)[6]);
}

TEST(GraspFeatures, WhatIsNoGraspIsSaid) {
  const std::vector<PinchStep> apart(60, {60.0});
  for (const FeatureSet set : kSets) {
    EXPECT_EQ(recordingFeatures(pinchProfile(apart), set).problem,
              "no grasp: matrices 1 and 5 never touch together for more than 20 frames in a row");
    EXPECT_EQ(recordingFeatures(testing::otherSensorProfile(40), set).problem,
              "the description of 'unknown sensor' names no two pads that pinch, which these "
              "features need (the set 'statistics' needs none)");
    const auto without = recordingFeatures(pinchProfile({40, {50.0, 100.0F, 100.0F}}, false), set);
    EXPECT_EQ(without.problem, "");
    ASSERT_EQ(without.grasps.size(), 1u);
    EXPECT_EQ(without.grasps[0].problem, "no joint angles");
    EXPECT_TRUE(without.grasps[0].values.empty());
  }
}

// A hand whose description names other pads: they are used, and it has a table of its own.
TEST(GraspFeatures, PadsAreTheHands) {
  auto file = std::make_shared<HandFile>(*sdh2().file);
  file->pinch->pads = {1, 3};
  file->json += " ";
  HandDescription swapped = sdh2();
  swapped.file = file;
  const Profile of = twoGrasps();
  ProfileBuilder builder(swapped);
  for (std::size_t i = 0; i < of.numFrames(); ++i) builder.addFrame(of.frame(i));
  for (std::size_t i = 0; i < of.numAngles(); ++i)
    builder.addAngles(of.angles(i).hostUs, of.angles(i).values);
  const Profile profile = builder.finish({});
  EXPECT_NE(recordingFeatures(profile, FeatureSet::kBest).problem.find("matrices 1 and 3"),
            std::string::npos);
  EXPECT_EQ(featureNames(FeatureSet::kStudy, swapped)[3], "std_3");
  EXPECT_EQ(featureNames(FeatureSet::kStudy, sdh2())[3], "std_5");
}

// Without two pads that pinch there are the statistics of the contact, and the others are refused.
TEST(GraspFeatures, AHandWithoutPinchHasStatistics) {
  const HandDescription& pad = builtInHand("flat_pad_16x16");
  EXPECT_EQ(defaultFeatureSet(pad), FeatureSet::kStatistics);
  EXPECT_EQ(defaultFeatureSet(sdh2()), FeatureSet::kBest);
  EXPECT_THROW(featureNames(FeatureSet::kBest, pad), Error);
  ProfileBuilder builder(pad);
  for (std::int64_t i = 0; i < 60; ++i) {
    std::vector<float> values(256, 0.0F);
    if (i >= 10 && i < 50) values[16 * 4 + 8] = 500.0F;
    builder.addFrame(i * 33'000, values);
  }
  const Profile profile = builder.finish({});
  const auto refused = recordingFeatures(profile, FeatureSet::kBest);
  EXPECT_TRUE(refused.grasps.empty());
  EXPECT_NE(refused.problem.find("names no two pads that pinch"), std::string::npos);
  const auto found = recordingFeatures(profile, FeatureSet::kStatistics);
  ASSERT_EQ(found.grasps.size(), 1u) << found.problem;
  EXPECT_EQ(found.grasps[0].begin, 10u);
  EXPECT_EQ(found.grasps[0].end, 49u);
  EXPECT_EQ(found.grasps[0].values.size(), featureNames(FeatureSet::kStatistics, pad).size());
}

TEST(GraspFeatures, CanBeCancelled) {
  EXPECT_THROW(findPinches(twoGrasps(), FeatureSet::kBest, [](double) { return false; }),
               Cancelled);
}

}  // namespace
}  // namespace palpate::grasp_features_test

#include "palpate/recognition/study_features.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/core/number_text.h"
#include "palpate/recognition/grasp_features.h"
#include "palpate/recording/recording.h"

#include "recognition/pinch_profile.h"
#include "testing/sdh2.h"
#include "testing/testing.h"

namespace palpate::study_features_test {
namespace {

using testing::pinchProfile;
using testing::PinchStep;

std::map<std::string, double> named(const StudyFeatures& features) {
  std::map<std::string, double> values;
  const auto names = studyFeatureNames(sdh2PinchHand());
  EXPECT_EQ(names.size(), features.values.size()) << features.problem;
  for (std::size_t i = 0; i < features.values.size(); ++i) values[names[i]] = features.values[i];
  return values;
}

TEST(StudyFeatures, AreFiftyFour) {
  const auto names = studyFeatureNames(sdh2PinchHand());
  ASSERT_EQ(names.size(), 54u);
  EXPECT_EQ(names[0], "diameter");
  EXPECT_EQ(names[3], "std_5");
  EXPECT_EQ(names[4], "m1_T00");
  EXPECT_EQ(names[9], "m1_T10");
  EXPECT_EQ(names[53], "m5_T44");
}

// 30 frames: the gap closes from 53 to 50 mm within 10 frames and stays. One pad touches at one
// taxel of 1777 counts (half of 3554), the other at one of 2493.
TEST(StudyFeatures, OfAGraspComputedByHand) {
  std::vector<PinchStep> steps;
  for (int i = 0; i < 30; ++i) steps.push_back({std::max(50.0, 53.0 - 0.3 * i), 1777.0F, 2493.0F});
  const Profile profile = pinchProfile(steps);
  const StudyFeatures features =
      studyFeatures(profile, {.begin = 0, .end = 29, .fingers = {}}, sdh2PinchHand());
  auto values = named(features);
  // Indentation: half a millimetre on the first pad, one on the second.
  EXPECT_NEAR(values["diameter"], 50.0 + 1.5, 1e-9);
  EXPECT_NEAR(values["compressibility"], 3.0, 1e-9);
  EXPECT_EQ(features.initialFrame, 0u);
  EXPECT_EQ(values["std_1"], 0.0) << "of one taxel";
  EXPECT_NEAR(values["m1_T00"], 1777.0 / 4096.0 / 14.0, 1e-12);
  EXPECT_NEAR(values["m5_T00"], 2493.0 / 4096.0 / 14.0, 1e-12);
  EXPECT_GE(features.endFrame, 19u) << "one before one of the last ten";
  EXPECT_LE(features.endFrame, 28u);
  EXPECT_LT(features.endFrame, features.otherEndFrame);
}

TEST(StudyFeatures, TheEndFrameIsOneOfTwo) {
  // Of ten diameters 59 .. 50 the middle ones are 55 and 54: frames 24 and 25, less one.
  std::vector<PinchStep> steps;
  for (int i = 0; i < 30; ++i) steps.push_back({79.0 - i, 1000.0F, 1000.0F});
  const Profile profile = pinchProfile(steps);
  const GraspSegment grasp{.begin = 0, .end = 29, .fingers = {}};
  const StudyFeatures features = studyFeatures(profile, grasp, sdh2PinchHand());
  EXPECT_EQ(features.endFrame, 23u);
  EXPECT_EQ(features.otherEndFrame, 24u);
  EXPECT_NEAR(named(features)["compressibility"], 23.0, 1e-9);
  EXPECT_NEAR(
      named(studyFeatures(profile, grasp, sdh2PinchHand(), 24))["compressibility"], 24.0, 1e-9);
  EXPECT_THROW(studyFeatures(profile, grasp, sdh2PinchHand(), 30), std::invalid_argument);
}

TEST(StudyFeatures, WhatIsMissingIsSaid) {
  const std::vector<PinchStep> good(30, {50.0, 1000.0F, 1000.0F});
  const auto problem = [](const Profile& profile, std::size_t end = 29) {
    const StudyFeatures features =
        studyFeatures(profile, {.begin = 0, .end = end, .fingers = {}}, sdh2PinchHand());
    EXPECT_TRUE(features.values.empty());
    return features.problem;
  };
  EXPECT_EQ(problem(pinchProfile(good, false)), "no joint angles");
  EXPECT_EQ(problem(pinchProfile(good), 19), "half a grasp: 20 frames, of at least 21");
  auto apart = good;
  apart[7].second = 0.0F;
  EXPECT_EQ(problem(pinchProfile(apart)), "matrix 5 doesn't touch in frame 7");
  EXPECT_EQ(problem(testing::otherSensorProfile(30)),
            "a recording of another sensor: its matrices are not those of the hand");
  EXPECT_EQ(problem(testing::damagedProfile(pinchProfile(good), 12, -1)),
            "values that are not numbers in frame 12");
  EXPECT_EQ(problem(testing::damagedProfile(pinchProfile(good), -1, 12)),
            "joint angles that are missing or not numbers in frame 12");
  EXPECT_THROW(problem(pinchProfile(good), 30), std::out_of_range);
}

// Compares 571 grasps with the results of two independent programs.
TEST(StudyFeatures, AgreeWithIndependentNumbers) {
  const auto golden = testing::goldenFolder();
  const auto recordings = testing::recordingsFolder();
  PALPATE_NEED(golden && recordings);
  std::istringstream lines(testing::readFile(*golden / "grasp_features.csv"));
  std::string line;
  const auto cellsOf = [](const std::string& text) {
    std::vector<std::string> cells(1);
    for (const char c : text)
      if (c == ',')
        cells.emplace_back();
      else if (c != '\r')
        cells.back() += c;
    return cells;
  };
  std::getline(lines, line);
  const std::vector<std::string> header = cellsOf(line), names = studyFeatureNames(sdh2PinchHand());
  ASSERT_EQ(header.size(), 62u);
  for (std::size_t i = 0; i < 54; ++i) ASSERT_EQ(header[i + 8], names[i]);
  std::size_t compared = 0;
  while (std::getline(lines, line)) {
    const auto cells = cellsOf(line);
    SCOPED_TRACE(cells[1]);
    const Profile profile = openRecording(*recordings / cells[1]);
    const auto grasps = findPinches(profile, FeatureSet::kStudy);
    ASSERT_EQ(grasps.size(), 1u);
    const StudyFeatures free = studyFeatures(profile, grasps[0], sdh2PinchHand());
    const auto end = static_cast<std::size_t>(*parseInteger(cells[5]));
    const std::string tie =
        std::to_string(free.endFrame) + ";" + std::to_string(free.otherEndFrame);
    const std::string tieOther =
        std::to_string(free.otherEndFrame) + ";" + std::to_string(free.endFrame);
    ASSERT_TRUE(cells[6] == tie || cells[6] == tieOther) << tie << " for " << cells[6];
    const StudyFeatures ours = studyFeatures(profile, grasps[0], sdh2PinchHand(), end);
    ASSERT_EQ(ours.problem, "");
    EXPECT_EQ(std::to_string(ours.initialFrame), cells[4]);
    for (std::size_t i = 0; i < 54; ++i) {
      const double expected = *parseDouble(cells[i + 8]);
      const double tolerance = i < 4 ? 1e-9 : 1e-6 * std::abs(expected);
      ASSERT_NEAR(ours.values[i], expected, tolerance) << names[i];
    }
    ++compared;
  }
  EXPECT_EQ(compared, 571u);
}

}  // namespace
}  // namespace palpate::study_features_test

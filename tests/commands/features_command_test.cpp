#include <filesystem>
#include <sstream>

#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recognition/grasp_features.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"
#include "recognition/pinch_profile.h"

namespace palpate::features_command_test {
namespace {
namespace fs = std::filesystem;

using testing::expectOneLineError;
using testing::palpate;
using testing::TemporaryFolder;

void saveGrasp(const fs::path& path, double gapMm, bool withAngles = true) {
  std::vector<testing::PinchStep> steps(10, {gapMm + 10.0});
  steps.insert(steps.end(), 30, {gapMm, 1000.0F, 400.0F});
  steps.insert(steps.end(), 10, {gapMm + 10.0});
  fs::create_directories(path.parent_path());
  saveRecording(testing::pinchProfile(steps, withAngles), {}, path);
}

std::vector<std::vector<std::string>> csvRows(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back(1);
    for (const char c : line)
      if (c == ',')
        rows.back().emplace_back();
      else
        rows.back().back() += c;
  }
  return rows;
}

TEST(FeaturesCommand, PrintsARowPerGraspWithItsClass) {
  const TemporaryFolder folder;
  saveGrasp(folder / "all/golf_ball/a.dsa", 40.0);
  saveGrasp(folder / "all/pen/a.dsa", 12.0);
  const auto result = palpate({"features", folder / "all"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const auto rows = csvRows(result.out);
  ASSERT_EQ(rows.size(), 3u);
  std::vector<std::string> header = {"class", "file", "begin", "end", "initial_frame", "end_frame"};
  for (const std::string& name : featureNames(FeatureSet::kBest, sdh2())) header.push_back(name);
  EXPECT_EQ(rows[0], header);
  EXPECT_EQ(rows[1][0], "golf ball");
  EXPECT_EQ(rows[1][1], (folder / "all/golf_ball/a.dsa").string());
  EXPECT_EQ(rows[1][2], "10");
  EXPECT_EQ(rows[1][3], "39");
  EXPECT_EQ(rows[2][0], "pen");
  // Digit for digit what the library says.
  const auto found = recordingFeatures(openRecording(folder / "all/pen/a.dsa"), FeatureSet::kBest);
  for (std::size_t i = 0; i < found.grasps[0].values.size(); ++i)
    EXPECT_EQ(parseDouble(rows[2][i + 6]), found.grasps[0].values[i]);
}

TEST(FeaturesCommand, KnowsTheSets) {
  const TemporaryFolder folder;
  saveGrasp(folder / "pen/a.dsa", 12.0);
  for (const char* set : {"study", "best", "session"}) {
    const auto result = palpate({"features", folder.path(), "--set", set});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(csvRows(result.out)[0].size(),
              6 + featureNames(*featureSetNamed(set), sdh2()).size());
    EXPECT_EQ(result.err.find("remembers the pose") != std::string::npos,
              set == std::string("session"));
  }
  EXPECT_EQ(palpate({"features", "-q", folder.path(), "--set", "session"}).err, "");
  expectOneLineError(
      palpate({"features", folder.path(), "--set", "all"}), 2, {"study, best, session"});
}

TEST(FeaturesCommand, WhatHasNoFeaturesIsSaid) {
  const TemporaryFolder folder;
  saveGrasp(folder / "x/good.dsa", 40.0);
  saveGrasp(folder / "x/noangles.dsa", 40.0, false);
  testing::writeFile(folder / "x/broken.dsa", "BZh9 but no more");
  const auto some = palpate({"features", folder / "x"});
  EXPECT_EQ(some.exitCode, 3);
  EXPECT_EQ(csvRows(some.out).size(), 2u);
  EXPECT_NE(some.err.find("noangles.dsa: grasp 10..39: no joint angles"), std::string::npos);
  EXPECT_NE(some.err.find("broken.dsa"), std::string::npos);
  const auto none = palpate({"features", folder / "x/noangles.dsa"});
  EXPECT_EQ(none.exitCode, 1);
  EXPECT_EQ(none.out, "");
  EXPECT_NE(none.err.find("no grasp with features in 1 recording"), std::string::npos);
  expectOneLineError(palpate({"features", folder / "missing"}), 1, {"missing"});
  EXPECT_EQ(palpate({"features"}).exitCode, 2);
}

TEST(FeaturesCommand, ExplainsItself) {
  const auto result = palpate({"features", "--help"});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_NE(result.out.find("Example:"), std::string::npos);
  EXPECT_NE(result.out.find("session     best"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace palpate::features_command_test

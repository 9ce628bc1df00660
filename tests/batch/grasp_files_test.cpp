#include "palpate/batch/grasp_files.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recognition/grasp_segments.h"
#include "palpate/signals/formula.h"

#include "testing/testing.h"

namespace palpate::grasp_files_test {
namespace {
namespace fs = std::filesystem;

Profile threeGrasps() { return synthesize({.durationS = 24.0, .grasps = 3}); }

TEST(GraspFiles, AreOfTheGraspsThatAreFound) {
  const Profile profile = threeGrasps();
  const auto found = findGrasps(profile);
  const auto frames = graspFrames(profile, {});
  ASSERT_EQ(frames.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(frames[i], (GraspFrames{found[i].begin, found[i].end}));
}

TEST(GraspFiles, AreOfTheGraspsThatAPersonHasCorrected) {
  const Profile profile = threeGrasps();
  const auto at = [&](std::size_t frame) { return profile.frameTimeUs(frame); };
  const std::vector<Event> events = {
      {at(200), at(300), "segment", std::nullopt, "grasp", ""},
      {at(50), at(50), "label", std::nullopt, "ball", ""},
      {at(10), at(20), "segment", std::nullopt, "grasp", ""},
      {at(30) + 1, at(30) + 2, "segment", std::nullopt, "between two frames", ""}};
  EXPECT_EQ(graspFrames(profile, events), (std::vector<GraspFrames>{{10, 20}, {200, 300}}));
  const std::vector<Event> none = {{at(0), at(0), "segment", std::nullopt, "no grasp", ""}};
  EXPECT_TRUE(graspFrames(profile, none).empty());
}

// The third file can't be made: what was written before is told.
TEST(GraspFiles, AFailureTellsHowManyWereWrittenBefore) {
  const testing::TemporaryFolder folder;
  const Profile profile = threeGrasps();
  const std::vector<GraspFrames> grasps = {{10, 20}, {200, 300}, {310, 320}};
  testing::writeFile(folder / "file", "no folder");
  const std::vector<fs::path> paths = {
      folder / "1.palpate", folder / "2.palpate", folder / "file/3.palpate"};
  try {
    saveGrasps(folder / "whole.palpate", profile, {}, grasps, paths);
    FAIL();
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).ends_with("; before it 2 of 3 grasps were written"))
        << error.what();
  }
  EXPECT_TRUE(fs::exists(paths[1]));
}

TEST(GraspFiles, AreNamedByATemplateWithTheirNumber) {
  const GraspTemplate names("out/{name}_{n}.palpate");
  EXPECT_EQ(names.pathFor({.name = "ball"}, 3, 12), "out/ball_03.palpate");
  EXPECT_EQ(names.pathFor({.name = "ball"}, 3, 120), "out/ball_003.palpate");
  EXPECT_EQ(names.ending(), ".palpate");
  EXPECT_THROW(GraspTemplate("out/{name}.palpate"), std::invalid_argument);
  EXPECT_THROW(GraspTemplate("{n}/{name}.palpate"), std::invalid_argument);
  EXPECT_THROW(GraspTemplate("out/{what}_{n}.palpate"), std::invalid_argument);
}

TEST(GraspFiles, HoldTheirFramesAndTheLabelsThatTouchThem) {
  const testing::TemporaryFolder folder;
  const Profile profile = threeGrasps();
  const std::vector<GraspFrames> grasps = {{10, 20}, {200, 300}};
  const auto at = [&](std::size_t frame) { return profile.frameTimeUs(frame); };
  const std::vector<Event> events = {{at(15), at(15), "label", std::nullopt, "first", ""},
                                     {at(250), at(400), "note", std::nullopt, "second", ""}};
  const std::vector<fs::path> paths = {folder / "new/a.palpate", folder / "new/b.palpate"};
  saveGrasps(folder / "whole.palpate", profile, events, grasps, paths);
  const Profile second = openRecording(paths[1]);
  ASSERT_EQ(second.numFrames(), 101u);
  EXPECT_EQ(second.frameTimeUs(0), at(200));
  EXPECT_EQ(second.frame(100).values, profile.frame(300).values);
  const auto labels = readEvents(paths[1]).events;
  ASSERT_EQ(labels.size(), 1u);
  EXPECT_EQ(labels[0].text, "second");
  EXPECT_EQ(readEvents(paths[0]).events.at(0).text, "first");
}

// A joint angle at a frame is interpolated between the samples around it, also at the first and at
// the last frame.
TEST(GraspFiles, HoldTheAnglesAndTemperaturesOfAllTheirFrames) {
  const testing::TemporaryFolder folder;
  const Profile profile = threeGrasps();
  const std::vector<GraspFrames> grasps = {{10, 20}, {200, 300}, {750, profile.numFrames() - 1}};
  const std::vector<fs::path> paths = {
      folder / "a.palpate", folder / "b.palpate", folder / "c.palpate"};
  saveGrasps(folder / "whole.palpate", profile, {}, grasps, paths);
  for (const char* text : {"angle1", "temperature0"}) {
    const Formula formula(text);
    const Series whole = formulaSeries(profile, formula, 0.0, 100.0);
    for (std::size_t i = 0; i < grasps.size(); ++i) {
      const Series part = formulaSeries(openRecording(paths[i]), formula, 0.0, 100.0);
      ASSERT_EQ(part.values.size(), grasps[i].end - grasps[i].begin + 1);
      for (std::size_t k = 0; k < part.values.size(); ++k) {
        const double expected = whole.values.at(grasps[i].begin + k);
        if (std::isnan(expected))
          EXPECT_TRUE(std::isnan(part.values[k])) << text << ", frame " << k;
        else
          EXPECT_NEAR(part.values[k], expected, 1e-6) << text << ", grasp " << i << ", frame " << k;
      }
    }
  }
}

TEST(GraspFiles, NothingIsWrittenWhenOneExistsAlready) {
  const testing::TemporaryFolder folder;
  const Profile profile = threeGrasps();
  const std::vector<GraspFrames> grasps = {{10, 20}, {200, 300}};
  const std::vector<fs::path> paths = {folder / "a.palpate", folder / "b.palpate"};
  testing::writeFile(paths[1], "mine");
  EXPECT_THROW(saveGrasps(folder / "whole.palpate", profile, {}, grasps, paths), FileError);
  EXPECT_FALSE(fs::exists(paths[0]));
  EXPECT_EQ(testing::readFile(paths[1]), "mine");
  const std::vector<fs::path> same = {folder / "c.palpate", folder / "c.palpate"};
  EXPECT_THROW(saveGrasps(folder / "whole.palpate", profile, {}, grasps, same), FileError);
  EXPECT_FALSE(fs::exists(folder / "c.palpate"));
  EXPECT_THROW(saveGrasps(folder / "c.palpate", profile, {}, grasps, {}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::grasp_files_test

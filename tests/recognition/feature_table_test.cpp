#include "palpate/recognition/feature_table.h"

#include <array>
#include <filesystem>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "recognition/pinch_profile.h"
#include "testing/testing.h"

namespace palpate::feature_table_test {
namespace {
namespace fs = std::filesystem;

using testing::pinchProfile;
using testing::PinchStep;
using testing::TemporaryFolder;

void saveGrasps(const fs::path& path, int grasps, bool withAngles = true) {
  std::vector<PinchStep> steps(10, {60.0});
  for (int i = 0; i < grasps; ++i) {
    steps.insert(steps.end(), 30, {50.0 + i, 1000.0F, 400.0F});
    steps.insert(steps.end(), 10, {60.0});
  }
  fs::create_directories(path.parent_path());
  saveRecording(pinchProfile(steps, withAngles), {}, path);
}

TEST(FeatureTable, ClassesAreTheNamesOfFolders) {
  const TemporaryFolder folder;
  saveGrasps(folder / "all/golf_ball/b.dsa", 2);
  saveGrasps(folder / "all/golf_ball/deeper/a.palpate", 1);
  saveGrasps(folder / "all/pen/a.dsa", 1);
  saveGrasps(folder / "all/alone.dsa", 1);
  const FeatureTable table = extractFeatures({folder / "all"});
  EXPECT_EQ(table.problems, std::vector<std::string>{});
  EXPECT_EQ(table.numFiles, 4u);
  ASSERT_EQ(table.rows.size(), 5u);
  EXPECT_EQ(table.rows[0].className, "all");
  EXPECT_EQ(table.rows[0].file, folder / "all/alone.dsa");
  EXPECT_EQ(table.rows[1].className, "golf ball");
  EXPECT_EQ(table.rows[2].begin, 50u) << "the second of one file";
  EXPECT_GT(table.rows[2].timeUs, table.rows[1].timeUs);
  EXPECT_EQ(table.rows[3].className, "golf ball");
  EXPECT_EQ(table.rows[4].className, "pen");
  EXPECT_EQ(table.classes(), (std::vector<std::string>{"all", "golf ball", "pen"}));
  EXPECT_EQ(table.sensor, sensorText(*sdh2().layout));
  // A file given by itself has no class; a folder of a class gives its class.
  EXPECT_EQ(extractFeatures({folder / "all/pen/a.dsa"}).rows[0].className, "");
  EXPECT_EQ(extractFeatures({folder / "all/golf_ball/"}).classes(),
            (std::vector<std::string>{"deeper", "golf ball"}));
}

TEST(FeatureTable, RowsHaveTheirNumberAndCanBeLeftOut) {
  const TemporaryFolder folder;
  saveGrasps(folder / "pen/a.dsa", 3);
  saveGrasps(folder / "pen/b.dsa", 1);
  const FeatureTable table = extractFeatures({folder.path()});
  ASSERT_EQ(table.rows.size(), 4u);
  const std::array<std::size_t, 4> numbers = {1, 2, 3, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(table.rows[i].number, numbers.at(i));
    EXPECT_GT(table.rows[i].quality, 0.0);
    EXPECT_LE(table.rows[i].quality, 1.0);
  }
  const FeatureTable kept = without(table,
                                    {{folder / "pen/a.dsa", table.rows[1].begin},
                                     {folder / "pen/b.dsa", table.rows[3].begin + 1},
                                     {folder / "gone.dsa", 0}});
  ASSERT_EQ(kept.rows.size(), 3u) << "what isn't there is ignored";
  EXPECT_EQ(kept.rows[1].number, 3u);
  EXPECT_EQ(kept.names, table.names);
  EXPECT_EQ(kept.sensor, table.sensor);
}

// Also when a set was asked for that the hand doesn't have.
TEST(FeatureTable, SaysWhetherTheHandPinches) {
  const TemporaryFolder folder;
  saveGrasps(folder / "pen/a.dsa", 1);
  EXPECT_TRUE(extractFeatures({folder / "pen"}, {.set = FeatureSet::kStatistics}).handPinches);
  ProfileBuilder builder(builtInHand("flat_pad_16x16"));
  builder.addFrame(0, std::vector<float>(256, 0.0F));
  fs::create_directories(folder / "pad");
  saveRecording(builder.finish({}), {}, folder / "pad/x.palpate");
  EXPECT_FALSE(extractFeatures({folder / "pad"}, {.set = FeatureSet::kBest}).handPinches);
  EXPECT_FALSE(extractFeatures({folder / "pad"}).handPinches);
}

TEST(FeatureTable, DoesNotDependOnThreads) {
  const TemporaryFolder folder;
  for (int i = 0; i < 6; ++i) saveGrasps(folder / ("c/f" + std::to_string(i) + ".dsa"), 1 + i % 2);
  const auto valuesWith = [&](std::size_t threads) {
    std::vector<std::vector<double>> values;
    for (const FeatureRow& row :
         extractFeatures({folder.path()}, {.set = FeatureSet::kStudy, .threads = threads}).rows)
      values.push_back(row.values);
    return values;
  };
  EXPECT_EQ(valuesWith(1), valuesWith(4));
  EXPECT_EQ(valuesWith(1).size(), 9u);
}

TEST(FeatureTable, OneBadFileDoesNotStopTheOthers) {
  const TemporaryFolder folder;
  saveGrasps(folder / "x/good.dsa", 1);
  saveGrasps(folder / "x/empty.dsa", 0);
  saveGrasps(folder / "x/noangles.dsa", 1, false);
  testing::writeFile(folder / "x/bad.dsa", "no recording");
  const FeatureTable table = extractFeatures({folder / "x"});
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0].file, folder / "x/good.dsa");
  EXPECT_EQ(table.numFiles, 4u);
  EXPECT_EQ(table.failedFiles, 1u);
  EXPECT_EQ(table.failedGrasps, 1u);
  ASSERT_EQ(table.problems.size(), 3u);
  EXPECT_NE(table.problems[0].find("bad.dsa"), std::string::npos);
  EXPECT_NE(table.problems[1].find("empty.dsa: no grasp"), std::string::npos);
  EXPECT_NE(table.problems[2].find("noangles.dsa: grasp 10..39: no joint angles"),
            std::string::npos);
}

TEST(FeatureTable, NothingThereIsSaid) {
  const TemporaryFolder folder;
  EXPECT_THROW(extractFeatures({folder / "missing"}), FileError);
  fs::create_directories(folder / "hollow");
  const FeatureTable table = extractFeatures({folder / "hollow"});
  EXPECT_TRUE(table.rows.empty());
  ASSERT_EQ(table.problems.size(), 1u);
  EXPECT_EQ(table.sensor, "");
}

TEST(FeatureTable, CanBeCancelled) {
  const TemporaryFolder folder;
  saveGrasps(folder / "x/a.dsa", 1);
  EXPECT_THROW(extractFeatures({folder / "x"}, {}, [](double) { return false; }), Cancelled);
}

TEST(FeatureTable, NamesOfClasses) {
  EXPECT_EQ(classOfFolder("a/golf_ball"), "golf ball");
  EXPECT_EQ(classOfFolder("a/ping-pong_ball/"), "ping-pong ball");
  EXPECT_EQ(classOfFolder("."), classOfFolder(fs::current_path()));
}

}  // namespace
}  // namespace palpate::feature_table_test

// What is remembered of objects, as a file. How a grasp uses it: grasp_state_machine_test and
// grasp_reach_test.
#include "palpate/control/grasp_approach.h"

#include <fstream>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/core/text_file.h"
#include "palpate/model/hand_file.h"

#include "testing/testing.h"

namespace palpate::grasp_approach_test {
namespace {
namespace fs = std::filesystem;
using testing::TemporaryFolder;

GraspReport touched(const std::string& preshape, const std::string& object, Touch touch) {
  GraspReport report;
  report.request.preshape = preshape;
  report.request.object = object;
  report.touch = touch;
  return report;
}

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

TEST(TouchFile, LiesInTheUsersDataFolder) {
  EXPECT_EQ(touchesFile(), userDataFolder() / "touches.json");
  EXPECT_EQ(touchesFile(TouchedBy::kEmulatedHand), userDataFolder() / "touches_emulated.json");
}

TEST(TouchFile, IsReadAsItWasWritten) {
  const TemporaryFolder folder;
  const fs::path file = folder / "not/made/yet/touches.json";
  EXPECT_TRUE(loadTouches(file).empty()) << "there is none at first";
  TouchMemory touches;
  touches.learn(touched("parallel", "tin \"A\"", {.ratio = 0.82, .riseCounts = 31.5}));
  touches.learn(touched("parallel", "Überraschungsei", {.ratio = 0.25, .riseN = 0.5}));
  touches.learn(touched("centrical", "ball", {.ratio = 0.5}));
  touches.learn(touched("centrical", "ball", {.ratio = 0.5}));
  saveTouches(touches, file);
  const TouchMemory read = loadTouches(file);
  EXPECT_EQ(read.objects("parallel"), (std::vector<std::string>{"tin \"A\"", "Überraschungsei"}));
  EXPECT_EQ(read.objects("spherical"), std::vector<std::string>());
  const auto tin = read.find("parallel", "tin \"A\"");
  ASSERT_TRUE(tin);
  EXPECT_EQ(tin->ratio, 0.82);
  EXPECT_EQ(tin->riseCounts, 31.5);
  EXPECT_EQ(tin->riseN, std::nullopt);
  EXPECT_EQ(read.find("parallel", "Überraschungsei")->riseN, 0.5);
  ASSERT_TRUE(read.find("centrical", "ball"));
  EXPECT_EQ(read.find("centrical", "ball")->grasps, 2);
  // What is forgotten is in the file no more.
  touches.forget("centrical", "ball");
  saveTouches(touches, file);
  EXPECT_FALSE(loadTouches(file).find("centrical", "ball"));
  EXPECT_TRUE(loadTouches(file).find("parallel", "tin \"A\""));
}

TEST(TouchFile, ADamagedOneIsRefusedAndNotChanged) {
  const TemporaryFolder folder;
  const fs::path file = folder / "touches.json";
  const std::string good =
      R"({"format": "palpate-touches", "version": 1, "touches": [{"preshape": "parallel", )"
      R"("object": "tin", "ratio": 0.5, "grasps": 1}]})";
  write(file, good);
  ASSERT_TRUE(loadTouches(file).find("parallel", "tin"));
  for (const std::string& bad : {std::string(),
                                 std::string("no"),
                                 std::string(R"({"format": "palpate-sequence", "version": 1})"),
                                 good.substr(0, good.size() - 5),
                                 [&] {
                                   std::string beyond = good;
                                   return beyond.replace(beyond.find("0.5"), 3, "1.5");
                                 }()}) {
    write(file, bad);
    EXPECT_THROW(loadTouches(file), FormatError) << bad;
    EXPECT_EQ(readTextFile(file, 10'000), bad);
  }
  EXPECT_THROW(loadTouches(folder.path()), FileError) << "a folder";
  // Where no folder can be made.
  EXPECT_THROW(saveTouches({}, file / "below/touches.json"), FileError);
}

}  // namespace
}  // namespace palpate::grasp_approach_test

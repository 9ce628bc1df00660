#include <algorithm>
#include <filesystem>
#include <sstream>

#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate::grasps_command_test {
namespace {
namespace fs = std::filesystem;

using testing::expectOneLineError;
using testing::palpate;
using testing::ProgramResult;
using testing::TemporaryFolder;

constexpr const char* kHeader = "begin,end,begin_ms,end_ms,fingers,quality";

// Of names without commas and quotes.
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

std::size_t linesIn(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

SyntheticOptions options(int grasps) {
  return {.durationS = 20.0, .angleRateHz = 0.0, .temperatureRateHz = 0.0, .grasps = grasps};
}

void synthesizeTo(const fs::path& path, int grasps) {
  saveRecording(synthesize(options(grasps)), {}, path);
}

TEST(GraspsCommand, PrintsARowPerGrasp) {
  const TemporaryFolder folder;
  SyntheticTruth truth;
  const Profile profile = synthesize(options(3), &truth);
  saveRecording(profile, {}, folder / "a.dsa");
  const auto result = palpate({"grasps", folder / "a.dsa"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const auto rows = csvRows(result.out);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(result.out.substr(0, result.out.find('\n')), kHeader);
  for (std::size_t i = 0; i < truth.grasps.size(); ++i) {
    const auto& row = rows[i + 1];
    ASSERT_EQ(row.size(), 6u);
    const auto begin = static_cast<std::size_t>(*parseInteger(row[0]));
    const auto end = static_cast<std::size_t>(*parseInteger(row[1]));
    // The lighter finger comes later and leaves earlier than "touched" of the truth.
    EXPECT_GE(begin, truth.grasps[i].begin);
    EXPECT_LE(begin, truth.grasps[i].begin + 3);
    EXPECT_LE(end, truth.grasps[i].end);
    EXPECT_GE(end + 3, truth.grasps[i].end);
    EXPECT_EQ(row[2], std::to_string(profile.frameTimeUs(begin) / 1000));
    EXPECT_EQ(row[3], std::to_string(profile.frameTimeUs(end) / 1000));
    EXPECT_EQ(row[4], "0 2");
    EXPECT_GT(*parseDouble(row[5]), 0.9) << "a whole, steady grasp";
    EXPECT_LE(*parseDouble(row[5]), 1.0);
  }
}

TEST(GraspsCommand, KnowsBothRules) {
  // Fingers 0 and 1 hold; the study looks at fingers 0 and 2 only.
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 60; ++i) {
    TactileFrame frame(sdh2().layout);
    if (i >= 10 && i < 50) frame.matrix(0)(4, 2) = frame.matrix(3)(6, 3) = 70.0F;
    builder.addFrame(1'700'000'000'000'000 + i * 40'000, frame.values);
  }
  const TemporaryFolder folder;
  saveRecording(builder.finish({}), {}, folder / "thumb.palpate");
  const std::string general = std::string(kHeader) + "\n10,49,1700000000400,1700000001960,0 1,1\n";
  EXPECT_EQ(palpate({"grasps", folder / "thumb.palpate"}).out, general);
  EXPECT_EQ(palpate({"grasps", folder / "thumb.palpate", "--rule", "general"}).out, general);
  const auto study = palpate({"grasps", folder / "thumb.palpate", "--rule", "study"});
  EXPECT_EQ(study.exitCode, 0);
  EXPECT_EQ(study.out, std::string(kHeader) + "\n");
  expectOneLineError(
      palpate({"grasps", folder / "thumb.palpate", "--rule", "mine"}), 2, {"--rule", "study"});
}

TEST(GraspsCommand, HelpSaysWhatQualityIs) {
  const std::string help = palpate({"grasps", "--help"}).out;
  for (const char* words :
       {"quality", "product", "saturated", "sd / mean", "ignored", "20 frames", "0.6 s"})
    EXPECT_NE(help.find(words), std::string::npos) << words;
}

TEST(GraspsCommand, MakesOneTableOfAFolder) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "b/c");
  synthesizeTo(folder / "b/c/two.palpate", 2);
  synthesizeTo(folder / "a.dsa", 1);
  synthesizeTo(folder / "b/none.dsa", 0);
  testing::writeFile(folder / "b/notes.txt", "no recording");
  const auto result = palpate({"grasps", folder.path().string()});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto rows = csvRows(result.out);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(result.out.substr(0, result.out.find('\n')), std::string(kHeader) + ",file");
  EXPECT_EQ(rows[1].at(6), (folder / "a.dsa").string());
  EXPECT_EQ(rows[2].at(6), (folder / "b/c/two.palpate").string());
  EXPECT_EQ(rows[3].at(6), rows[2].at(6));
  // The same rows as of each file alone.
  const auto alone = csvRows(palpate({"grasps", folder / "b/c/two.palpate"}).out);
  for (std::size_t column = 0; column < 6; ++column)
    EXPECT_EQ(rows[3][column], alone[2][column]) << column;
}

TEST(GraspsCommand, OneBadFileStopsNoOther) {
  const TemporaryFolder folder;
  synthesizeTo(folder / "a.dsa", 1);
  testing::writeFile(folder / "b.dsa", "BZh9 and then nothing of the kind");
  synthesizeTo(folder / "c.dsa", 2);
  const auto result = palpate({"grasps", folder.path().string()});
  EXPECT_EQ(linesIn(result.out), 4u) << result.out;
  expectOneLineError(result, 3, {(folder / "b.dsa").string()});
  const auto bad = palpate({"grasps", folder / "b.dsa"});
  expectOneLineError(bad, 1, {"b.dsa"});
  EXPECT_EQ(bad.out, "") << "no header of nothing";
}

TEST(GraspsCommand, ASensorWithoutTwoPadsThatPinchIsSaid) {
  const TemporaryFolder folder;
  const auto pads =
      std::make_shared<SensorLayout>(std::vector<MatrixLayout>(2, MatrixLayout::full(4, 4, 3.4)));
  ProfileBuilder builder(pads);
  for (int i = 0; i < 40; ++i) {
    TactileFrame frame(pads);
    if (i >= 5 && i < 35) frame.matrix(0)(1, 1) = frame.matrix(1)(2, 2) = 50.0F;
    builder.addFrame(1'700'000'000'000'000 + i * 40'000, frame.values);
  }
  saveRecording(builder.finish({}), {}, folder / "pads.palpate");
  const auto study = palpate({"grasps", folder / "pads.palpate", "--rule", "study"});
  expectOneLineError(study, 1, {"pads.palpate", "two pads that pinch", "--rule general"});
  EXPECT_EQ(study.out, "");
  const auto general = csvRows(palpate({"grasps", folder / "pads.palpate"}).out);
  ASSERT_EQ(general.size(), 2u);
  EXPECT_EQ(general[1][0], "5");
  EXPECT_EQ(general[1][4], "0 1");
}

TEST(GraspsCommand, OddRecordingsHaveNone) {
  const TemporaryFolder folder;
  ProfileBuilder one(sdh2().layout);
  one.addFrame(1'700'000'000'000'000, TactileFrame(sdh2().layout).values);
  saveRecording(one.finish({}), {}, folder / "one.dsa");
  const auto result = palpate({"grasps", folder / "one.dsa"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out, std::string(kHeader) + "\n");
  expectOneLineError(palpate({"grasps", folder / "missing.dsa"}), 1, {"missing.dsa"});
  EXPECT_EQ(palpate({"grasps"}).exitCode, 2);
  fs::create_directories(folder / "empty");
  expectOneLineError(palpate({"grasps", folder / "empty"}), 1, {"no recording"});
}

// 571 grasps, one per file (golden/grasp_features.csv: 571 rows), by both rules.
TEST(GraspsCommand, FindsOneGraspInEachOfTheSharedClasses) {
  const auto shared = testing::recordingsFolder();
  PALPATE_NEED(shared);
  for (const char* rule : {"general", "study"}) {
    const auto result = palpate({"grasps", (*shared / "grasps_by_class").string(), "--rule", rule});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    auto rows = csvRows(result.out);
    ASSERT_EQ(rows.size(), 1u + 571u);
    std::vector<std::string> files;
    for (std::size_t i = 1; i < rows.size(); ++i) files.push_back(rows[i].at(6));
    EXPECT_EQ(std::adjacent_find(files.begin(), files.end()), files.end());
  }
}

}  // namespace
}  // namespace palpate::grasps_command_test

#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate::labels_command_test {
namespace {
namespace fs = std::filesystem;

using testing::expectOneLineError;
using testing::palpate;
using testing::TemporaryFolder;

class LabelsCommandTest : public ::testing::Test {
 protected:
  LabelsCommandTest() : path_(folder_ / "run.palpate") {
    const Profile profile = synthesize({.durationS = 10.0, .grasps = 1});
    const std::int64_t t0 = profile.frameTimeUs(0);
    saveRecording(
        profile,
        std::vector<Event>{{t0 + 1'000'000, t0 + 2'500'000, "label", 2, "ball, red", ""},
                           {t0 + 3'000'000, t0 + 3'000'000, "note", std::nullopt, "slipped", ""}},
        path_);
  }
  TemporaryFolder folder_;
  fs::path path_;
};

constexpr const char* kTable =
    "begin_s,end_s,kind,text,matrix\n"
    "1.000000,2.500000,label,\"ball, red\",2\n"
    "3.000000,3.000000,note,slipped,\n";

TEST_F(LabelsCommandTest, PrintsATableThatAnotherRecordingTakes) {
  const auto printed = palpate({"labels", path_});
  EXPECT_EQ(printed.exitCode, 0) << printed.err;
  EXPECT_EQ(printed.out, kTable);
  testing::writeFile(folder_ / "labels.csv", printed.out);
  for (const char* name : {"other.palpate", "other.dsa"}) {
    const fs::path other = folder_ / name;
    saveRecording(synthesize({.durationS = 10.0, .grasps = 1}), {}, other);
    const auto added = palpate({"labels", other, "--import", folder_ / "labels.csv"});
    EXPECT_EQ(added.exitCode, 0) << added.err;
    EXPECT_NE(added.out.find("2 labels added"), std::string::npos) << added.out;
    EXPECT_EQ(palpate({"labels", other}).out, kTable);
  }
  const auto again = palpate({"labels", path_, "--import", folder_ / "labels.csv"});
  EXPECT_NE(again.out.find("0 labels added, 2 were there already"), std::string::npos) << again.out;
  EXPECT_EQ(palpate({"labels", path_}).out, kTable);
}

TEST_F(LabelsCommandTest, OfAFolderTheTableNamesTheFiles) {
  const auto printed = palpate({"labels", folder_.path()});
  EXPECT_EQ(printed.exitCode, 0) << printed.err;
  EXPECT_EQ(printed.out.substr(0, printed.out.find('\n')), "begin_s,end_s,kind,text,matrix,file");
  EXPECT_NE(printed.out.find("slipped,," + path_.string()), std::string::npos) << printed.out;
}

// stranger S4: the labels of all files were added to one.
TEST_F(LabelsCommandTest, TakesTheRowsOfItsFileOnly) {
  const fs::path other = folder_ / "other.palpate";
  const fs::path table = folder_ / "labels.csv";
  saveRecording(synthesize({.durationS = 10.0, .grasps = 1}), {}, other);
  const auto import = [&](const fs::path& file) {
    return palpate({"labels", file, "--import", table});
  };
  testing::writeFile(table,
                     "begin_s,text,file\n1,mine," + other.string() + "\n2,theirs," +
                         path_.string() + "\n3,moved,/gone/other.palpate\n");
  const auto added = import(other);
  EXPECT_EQ(added.exitCode, 0) << added.err;
  EXPECT_NE(added.out.find("2 labels added; 1 row of other recordings not taken"),
            std::string::npos)
      << added.out;
  const std::string labels = palpate({"labels", other}).out;
  EXPECT_NE(labels.find("mine"), std::string::npos) << labels;
  EXPECT_NE(labels.find("moved"), std::string::npos) << labels;
  EXPECT_EQ(labels.find("theirs"), std::string::npos) << labels;
  testing::writeFile(table, "begin_s,text,file\n1,theirs," + path_.string() + "\n");
  expectOneLineError(import(other), 1, {"its column file names other recordings in each row"});
}

TEST_F(LabelsCommandTest, NamesBadRowsByTheirLine) {
  const fs::path table = folder_ / "labels.csv";
  testing::writeFile(table, "begin_s,text\n4,good\n400,late\n");
  const auto part = palpate({"labels", path_, "--import", table});
  expectOneLineError(part, 3, {"labels.csv: line 3: begin_s '400' is outside"});
  EXPECT_NE(palpate({"labels", path_}).out.find("4.000000,4.000000,label,good,"),
            std::string::npos);
  testing::writeFile(table, "begin_s,text\n400,late\n");
  EXPECT_EQ(palpate({"labels", path_, "--import", table}).exitCode, 1);
  testing::writeFile(table, "start,label\n1,a\n");
  expectOneLineError(palpate({"labels", path_, "--import", table}), 1, {"labels.csv", "begin_s"});
  expectOneLineError(palpate({"labels", path_, path_, "--import", table}), 2, {"one FILE"});
  expectOneLineError(palpate({"labels", path_, "--import", folder_ / "none.csv"}), 1, {"none.csv"});
  expectOneLineError(palpate({"labels", path_, "--import", table, "--json"}), 2, {"--import"});
}

}  // namespace
}  // namespace palpate::labels_command_test

#include "palpate/core/json.h"

#include "commands/palpate_program.h"

namespace palpate::verify_command_test {
namespace {

using testing::palpate;

class VerifyCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(palpate({"synthesize", "-o", sound(), "--duration", "2"}).exitCode, 0);
    const std::string bytes = testing::readFile(sound());
    testing::writeFile(unreadable(), bytes.substr(0, bytes.size() / 2));  // one block, cut
    // Plain XML, cut: the frames before the cut can be read.
    const std::string xml =
        testing::runProgram("/bin/sh", {"-c", "bzip2 -dc '" + sound() + "'"}).out;
    testing::writeFile(damaged(), xml.substr(0, xml.size() / 4));
  }
  std::string sound() const { return folder_ / "sound.dsa"; }
  std::string damaged() const { return folder_ / "damaged.dsa"; }
  std::string unreadable() const { return folder_ / "unreadable.dsa"; }

  testing::TemporaryFolder folder_;
};

TEST_F(VerifyCommand, ExitCodeTellsTheState) {
  EXPECT_EQ(palpate({"verify", sound()}).exitCode, 0);
  EXPECT_EQ(palpate({"verify", damaged()}).exitCode, 3);
  EXPECT_EQ(palpate({"verify", unreadable()}).exitCode, 1);
  EXPECT_EQ(palpate({"verify", sound() + "-missing"}).exitCode, 1);
}

TEST_F(VerifyCommand, OfSeveralFilesTheWorst) {
  EXPECT_EQ(palpate({"verify", sound(), damaged(), sound()}).exitCode, 3);
  EXPECT_EQ(palpate({"verify", unreadable(), damaged(), sound()}).exitCode, 1);
}

TEST_F(VerifyCommand, OneLinePerFileSaysWhatCanBeRead) {
  const auto result = palpate({"verify", sound(), damaged(), unreadable()});
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 3) << result.out;
  EXPECT_NE(result.out.find("sound.dsa: sound: 64 frames"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("damaged.dsa: damaged: "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("unreadable.dsa: unreadable: "), std::string::npos) << result.out;
  EXPECT_EQ(result.err, "");
}

TEST_F(VerifyCommand, WritesATableToAFile) {
  const std::string csv = folder_ / "states.csv", json = folder_ / "states.json";
  const auto result = palpate({"verify", sound(), damaged(), unreadable(), "-o", csv});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_EQ(result.out, csv + "\n");
  const std::string table = testing::readFile(csv);
  EXPECT_TRUE(table.starts_with("file,state,message\n" + sound() + ",sound,")) << table;
  EXPECT_NE(table.find("\n" + damaged() + ",damaged,"), std::string::npos) << table;
  EXPECT_NE(table.find("\n" + unreadable() + ",unreadable,"), std::string::npos) << table;
  EXPECT_EQ(palpate({"verify", sound(), "-o", json}).exitCode, 0);
  EXPECT_EQ(Json::parse(testing::readFile(json)).at("rows").size(), 1u);
  testing::expectOneLineError(palpate({"verify", sound(), "-o", csv}), 1, {"states.csv"});
  const testing::TemporaryFolder empty;
  testing::expectOneLineError(
      palpate({"verify", empty.path(), "-o", csv, "--force"}), 1, {"no recording"});
  EXPECT_EQ(testing::readFile(csv), table);
  testing::expectOneLineError(palpate({"verify", sound(), "-o", "x.txt"}), 2, {".csv, .json"});
}

TEST_F(VerifyCommand, OneRecordingBehindAnotherIsNotMixedWithIt) {
  const std::string bytes = testing::readFile(sound());
  testing::writeFile(damaged(), bytes + bytes);
  const auto result = palpate({"verify", damaged()});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(result.out.find(" 64 frames"), std::string::npos) << result.out;
}

TEST_F(VerifyCommand, QuietIsTheExitCodeAlone) {
  const auto result = palpate({"verify", "--quiet", damaged()});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "");
}

TEST_F(VerifyCommand, AFolderStandsForItsRecordings) {
  const auto result = palpate({"verify", folder_.path()});
  EXPECT_EQ(result.exitCode, 1);  // the worst
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 3) << result.out;
  EXPECT_EQ(result.out.rfind(damaged() + ": damaged: ", 0), 0u) << result.out;
  std::filesystem::remove(unreadable());
  EXPECT_EQ(palpate({"verify", folder_.path()}).exitCode, 3);
  std::filesystem::remove(damaged());
  EXPECT_EQ(palpate({"verify", folder_.path()}).exitCode, 0);
}

TEST_F(VerifyCommand, EverySharedRecordingIsSound) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  const auto result = palpate({"verify", folder->string()});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 609) << result.err;
  std::size_t sound = 0;
  for (auto at = result.out.find(": sound: "); at != std::string::npos;
       at = result.out.find(": sound: ", at + 1))
    ++sound;
  EXPECT_EQ(sound, 609u);
}

}  // namespace
}  // namespace palpate::verify_command_test

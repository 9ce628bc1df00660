#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate {
namespace {

using testing::expectOneLineError;
using testing::palpate;

class ConvertCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(palpate({"synthesize", "-o", in("a.dsa"), "--duration", "2"}).exitCode, 0);
  }
  std::string in(const char* name) const { return folder_ / name; }

  testing::TemporaryFolder folder_;
};

TEST_F(ConvertCommand, toNativeAndBackGivesTheSameXml) {
  ASSERT_EQ(palpate({"convert", in("a.dsa"), in("b.palpate")}).exitCode, 0);
  ASSERT_EQ(palpate({"convert", in("b.palpate"), in("c.dsa")}).exitCode, 0);
  const auto xml = [&](const char* name) {
    return testing::runProgram("/bin/sh", {"-c", "bzip2 -dc '" + in(name) + "'"}).out;
  };
  EXPECT_FALSE(xml("a.dsa").empty());
  EXPECT_TRUE(xml("a.dsa") == xml("c.dsa"));
  const auto info = palpate({"info", in("b.palpate")});
  EXPECT_EQ(info.exitCode, 0);
  EXPECT_NE(info.out.find("palpate"), std::string::npos) << info.out;
  EXPECT_EQ(palpate({"verify", in("b.palpate")}).exitCode, 0);
}

TEST_F(ConvertCommand, aRangeOfFramesIncludesBothEnds) {
  ASSERT_EQ(
      palpate({"convert", in("a.dsa"), in("b.palpate"), "--from", "10", "--to", "19"}).exitCode, 0);
  const Profile whole = openRecording(in("a.dsa"));
  const Profile part = openRecording(in("b.palpate"));
  ASSERT_EQ(part.numFrames(), 10u);
  EXPECT_EQ(part.frameTimeUs(0), whole.frameTimeUs(10));
  EXPECT_EQ(part.frame(9).values, whole.frame(19).values);
  expectOneLineError(
      palpate({"convert", in("a.dsa"), in("c.dsa"), "--from", "60", "--to", "64"}), 1, {"0..63"});
  EXPECT_FALSE(std::filesystem::exists(in("c.dsa")));
}

TEST_F(ConvertCommand, csvHasARowPerActiveTaxelAndItsNeighbours) {
  ASSERT_EQ(palpate({"convert", in("a.dsa"), in("a.csv")}).exitCode, 0);
  const Profile profile = openRecording(in("a.dsa"));
  std::ptrdiff_t active = 0;
  for (std::size_t i = 0; i < profile.numFrames(); ++i)
    for (const float value : profile.frame(i).values) active += value > 0.0F ? 1 : 0;
  const std::string table = testing::readFile(in("a.csv"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), active + 1);
  EXPECT_EQ(table.substr(0, table.find('\n')), "frame,time_ms,matrix,y,x,value");
  const std::string angles = testing::readFile(in("a.csv.angles.csv"));
  EXPECT_EQ(std::count(angles.begin(), angles.end(), '\n'),
            static_cast<std::ptrdiff_t>(profile.numAngles()) + 1);
}

TEST_F(ConvertCommand, nothingIsReplacedWithoutForceAndNeverTheInput) {
  const std::string before = testing::readFile(in("a.dsa"));
  testing::writeFile(in("b.palpate"), "mine");
  expectOneLineError(palpate({"convert", in("a.dsa"), in("b.palpate")}), 1, {"exists already"});
  EXPECT_EQ(testing::readFile(in("b.palpate")), "mine");
  EXPECT_EQ(palpate({"convert", in("a.dsa"), in("b.palpate"), "--force"}).exitCode, 0);
  expectOneLineError(
      palpate({"convert", in("a.dsa"), in("a.dsa"), "--force"}), 1, {"is the input itself"});
  EXPECT_TRUE(testing::readFile(in("a.dsa")) == before);
  expectOneLineError(palpate({"convert", in("a.dsa"), in("a.txt")}), 1, {".dsa, .palpate, .csv"});
}

TEST_F(ConvertCommand, labelsComeAlong) {
  const RecordingEvent label{1'400'000'000'000'000, 1'400'000'000'000'000, "label", 2, "edge", ""};
  const std::vector<RecordingEvent> events{label};
  saveRecording(openRecording(in("a.dsa")), events, in("b.palpate"));
  ASSERT_EQ(palpate({"convert", in("b.palpate"), in("c.dsa")}).exitCode, 0);
  ASSERT_EQ(palpate({"convert", in("c.dsa"), in("d.palpate")}).exitCode, 0);
  EXPECT_EQ(readEvents(in("d.palpate")).events, events);
}

}  // namespace
}  // namespace palpate

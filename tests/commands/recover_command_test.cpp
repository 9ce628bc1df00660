#include "palpate/recording/palpate_writer.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate::recover_command_test {
namespace {

using testing::expectOneLineError;
using testing::palpate;

class RecoverCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(palpate({"synthesize", "-o", in("a.dsa"), "--duration", "4"}).exitCode, 0);
    ASSERT_EQ(palpate({"convert", in("a.dsa"), in("a.palpate")}).exitCode, 0);
  }
  std::string in(const char* name) const { return folder_ / name; }

  testing::TemporaryFolder folder_;
};

TEST_F(RecoverCommand, aSoundRecordingLosesNothing) {
  for (const char* name : {"a.dsa", "a.palpate"}) {
    const auto result = palpate({"recover", in(name), in("out.palpate"), "--force"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(palpate({"verify", in("out.palpate")}).exitCode, 0);
    EXPECT_EQ(openRecording(in("out.palpate")).numFrames(), openRecording(in(name)).numFrames());
  }
}

TEST_F(RecoverCommand, aDamagedNativeRecordingGivesItsIntactFrames) {
  std::string bytes = testing::readFile(in("a.palpate"));
  // Near the end of a page in the middle of the file: SQLite fills pages from their end.
  constexpr std::size_t kPage = 4096;
  const std::size_t at = bytes.size() / 2 / kPage * kPage + kPage - 96;
  const std::string damagedBytes = bytes.replace(at, 4, "\x01\x02\x03\x04");
  testing::writeFile(in("damaged.palpate"), damagedBytes);
  EXPECT_EQ(palpate({"verify", in("damaged.palpate")}).exitCode, 3);
  const auto result = palpate({"recover", in("damaged.palpate"), in("out.dsa")});
  EXPECT_EQ(result.exitCode, 3) << result.err;
  EXPECT_NE(result.out.find("saved "), std::string::npos) << result.out;
  EXPECT_EQ(palpate({"verify", in("out.dsa")}).exitCode, 0);
  EXPECT_TRUE(testing::readFile(in("damaged.palpate")) == damagedBytes);
}

TEST_F(RecoverCommand, anUnfinishedRecordingIsWhole) {
  {
    const Profile profile = openRecording(in("a.dsa"));
    PalpateWriter writer(in("unfinished.palpate"), profile.hand().layout);
    for (std::size_t i = 0; i < profile.numFrames(); ++i) writer.addFrame(profile.frame(i));
  }
  EXPECT_EQ(palpate({"verify", in("unfinished.palpate")}).exitCode, 0);
  EXPECT_EQ(palpate({"recover", in("unfinished.palpate"), in("out.palpate")}).exitCode, 0);
  EXPECT_EQ(openRecording(in("out.palpate")).numFrames(), openRecording(in("a.dsa")).numFrames());
}

TEST_F(RecoverCommand, whereNothingIsLeftThereIsNoOutput) {
  testing::writeFile(in("empty.palpate"), std::string(10'000, 'x'));
  testing::writeFile(in("cut.dsa"), testing::readFile(in("a.dsa")).substr(0, 2000));
  for (const char* name : {"empty.palpate", "cut.dsa"}) {
    expectOneLineError(palpate({"recover", in(name), in("out.palpate")}), 1, {name});
    EXPECT_FALSE(std::filesystem::exists(in("out.palpate")));
  }
  expectOneLineError(
      palpate({"recover", in("missing.dsa"), in("out.palpate")}), 1, {"missing.dsa"});
}

}  // namespace
}  // namespace palpate::recover_command_test

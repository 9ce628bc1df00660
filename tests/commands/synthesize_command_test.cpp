#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate {
namespace {

using testing::expectOneLineError;
using testing::palpate;

TEST(SynthesizeCommand, MakesARecordingAsAsked) {
  const testing::TemporaryFolder folder;
  const auto result = palpate(
      {"synthesize", "-o", folder / "a.dsa", "--duration", "4", "--rate", "25", "--grasps", "1"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  const Profile profile = openRecording(folder / "a.dsa");
  EXPECT_EQ(profile.numFrames(), 101u);
  EXPECT_EQ(profile.info().format, "dsa");
}

TEST(SynthesizeCommand, NeverReplacesAFileUnlessForced) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "a.dsa", "precious");
  expectOneLineError(palpate({"synthesize", "-o", folder / "a.dsa"}), 1, {"a.dsa", "--force"});
  EXPECT_EQ(testing::readFile(folder / "a.dsa"), "precious");
  EXPECT_EQ(palpate({"synthesize", "-o", folder / "a.dsa", "--force"}).exitCode, 0);
  EXPECT_NE(testing::readFile(folder / "a.dsa"), "precious");
}

TEST(SynthesizeCommand, RefusesBadOptions) {
  expectOneLineError(palpate({"synthesize"}), 2, {"-o"});
  expectOneLineError(palpate({"synthesize", "-o", "x", "--duration", "-1"}), 2, {"--duration"});
  expectOneLineError(palpate({"synthesize", "-o", "/nowhere/x.dsa"}), 1, {"/nowhere/x.dsa"});
}

// The recording in data/ is the generator's work, reproducible by the command its README names.
TEST(SynthesizeCommand, MadeTheRecordingInData) {
  const testing::TemporaryFolder folder;
  ASSERT_EQ(palpate({"synthesize",
                     "-o",
                     folder / "demo.dsa",
                     "--duration",
                     "24",
                     "--grasps",
                     "4",
                     "--noise",
                     "8",
                     "--seed",
                     "7"})
                .exitCode,
            0);
  EXPECT_EQ(testing::readFile(folder / "demo.dsa"),
            testing::readFile(testing::dataFolder() / "demo_grasps.dsa"));
}

}  // namespace
}  // namespace palpate

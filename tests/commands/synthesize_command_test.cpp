#include <numbers>

#include "palpate/recognition/empty_hand.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate::synthesize_command_test {
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
  expectOneLineError(palpate({"synthesize", "-o", "x.dsa", "--duration", "-1"}), 2, {"--duration"});
  expectOneLineError(palpate({"synthesize", "-o", "x.png"}), 2, {".dsa", ".palpate"});
  expectOneLineError(
      palpate({"synthesize", "-o", "x.dsa", "--duration", "1", "--grasps", "9"}), 1, {"9 grasps"});
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

// The fingertips of an empty hand stop each other; what the joints say then is the hand's error.
TEST(SynthesizeCommand, TheEmptyHandOfAnotherDayTouchesAtOtherAngles) {
  const testing::TemporaryFolder folder;
  const auto make = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"synthesize", "--scene", "empty_touch", "-o", folder / name};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(palpate(words).exitCode, 0);
    return openRecording(folder / name);
  };
  const Profile first = make("first.dsa", {});
  const Profile later = make("later.dsa", {"--zero-error", "-1", "--days-later", "3"});
  EXPECT_EQ(later.frameTimeUs(0) - first.frameTimeUs(0), 3 * 24 * 3600 * 1'000'000LL);
  const EmptyHandZero a = emptyHandZero(first), b = emptyHandZero(later);
  ASSERT_EQ(a.problem, "");
  ASSERT_EQ(b.problem, "");
  // Both proximal joints at about 150 mm from the pads: 2 x 150 mm x 1 deg, less what their lean
  // takes.
  EXPECT_LT(b.mm - a.mm, -3.0);
  EXPECT_GT(b.mm - a.mm, -2.0 * 150.0 * std::numbers::pi / 180.0);
  expectOneLineError(
      palpate({"synthesize", "-o", "x.dsa", "--zero-error", "1"}), 2, {"--zero-error", "--scene"});
}

}  // namespace
}  // namespace palpate::synthesize_command_test

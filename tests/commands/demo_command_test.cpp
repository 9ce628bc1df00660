#include "palpate/core/json.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate::demo_command_test {
namespace {

namespace fs = std::filesystem;
using testing::expectOneLineError;
using testing::palpate;

// No display at all: the tour must not need one.
const std::map<std::string, std::string> kHeadless = {
    {"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}, {"QT_QPA_PLATFORM", ""}};

TEST(DemoCommand, GraspsRecordsReplaysExportsAndDrawsWithoutADisplay) {
  const testing::TemporaryFolder folder;
  const auto result = palpate({"demo", "-o", folder / "tour"}, kHeadless);
  EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
  for (const char* step : {"emulate", "grasp", "record", "replay", "export", "signals", "window"})
    EXPECT_NE(result.out.find(std::string(step) + ": ok, "), std::string::npos) << result.out;
  for (const char* step : {"slip", "recognition"})
    EXPECT_NE(result.out.find(std::string(step) + ": skipped, "), std::string::npos) << result.out;
  EXPECT_EQ(testing::readFile(folder / "tour" / "window.png").substr(1, 3), "PNG");
  const Json report = Json::parse(testing::readFile(folder / "tour" / "report.json"));
  EXPECT_EQ(report.at("steps").size(), 9u);
  // What was recorded: all three fingertips felt the ball, at the rate of the real hand.
  const Profile profile = openRecording(folder / "tour" / "grasp.palpate");
  const Profile exported = openRecording(folder / "tour" / "grasp.dsa");
  ASSERT_EQ(report.at("recording").at("frames").asInteger(),
            static_cast<std::int64_t>(profile.numFrames()));
  EXPECT_EQ(exported.numFrames(), profile.numFrames());
  EXPECT_GT(profile.numFrames(), 150u);
  EXPECT_NEAR(timingOf(profile).meanRateHz, 31.7, 1.0);
  EXPECT_GT(static_cast<double>(profile.numAngles()) * 1e6,
            50.0 * static_cast<double>(profile.durationUs()));
  for (const std::size_t fingertip : {1u, 3u, 5u}) {
    float most = 0.0F;
    for (std::size_t i = 0; i < profile.numFrames(); ++i)
      most = std::max(most, profile.frame(i).matrix(fingertip).maxCoeff());
    EXPECT_GT(most, 100.0F) << fingertip;
  }
  for (std::size_t i = 0; i < profile.numFrames(); i += 37)
    EXPECT_EQ(exported.frame(i).values, profile.frame(i).values) << i;
}

TEST(DemoCommand, NeverWritesIntoAFolderThatExists) {
  const testing::TemporaryFolder folder;
  fs::create_directory(folder / "tour");
  EXPECT_EQ(palpate({"demo", "-o", folder / "tour"}, kHeadless).exitCode, 0);
  EXPECT_EQ(palpate({"demo", "-o", (folder / "tour").string() + "/"}, kHeadless).exitCode, 0);
  EXPECT_TRUE(fs::is_empty(folder / "tour"));
  EXPECT_TRUE(fs::exists(folder / "tour-3" / "report.json"));
  EXPECT_TRUE(fs::exists(folder / "tour-2" / "report.json"));
}

TEST(DemoCommand, SaysWhatFailed) {
  expectOneLineError(palpate({"demo", "-o", "/nowhere/tour"}, kHeadless), 1, {"/nowhere/tour"});
  const testing::TemporaryFolder folder;
  auto environment = kHeadless;
  environment["PALPATE_DATA"] = folder / "nothing";
  const auto result = palpate({"demo", "-o", folder / "tour"}, environment);
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.out.find("emulate: failed, "), std::string::npos) << result.out;
  EXPECT_TRUE(fs::exists(folder / "tour" / "report.json"));
}

}  // namespace
}  // namespace palpate::demo_command_test

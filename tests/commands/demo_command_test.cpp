#include "palpate/core/json.h"

#include "commands/palpate_program.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using testing::expectOneLineError;
using testing::palpate;

// No display at all: the tour must not need one.
const std::map<std::string, std::string> kHeadless = {
    {"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}, {"QT_QPA_PLATFORM", ""}};

TEST(DemoCommand, ReportsAndDrawsWithoutADisplay) {
  const testing::TemporaryFolder folder;
  const auto result = palpate({"demo", "-o", folder / "tour"}, kHeadless);
  EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
  EXPECT_NE(result.out.find("read: ok, 761 frames\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("window: ok, "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("slip: skipped, "), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("failed"), std::string::npos) << result.out;
  EXPECT_EQ(testing::readFile(folder / "tour" / "window.png").substr(1, 3), "PNG");
  const Json report = Json::parse(testing::readFile(folder / "tour" / "report.json"));
  EXPECT_EQ(report.at("recording").at("frames").asInteger(), 761);
  EXPECT_GT(report.at("steps").size(), 5u);
}

TEST(DemoCommand, NeverWritesIntoAFolderThatExists) {
  const testing::TemporaryFolder folder;
  fs::create_directory(folder / "tour");
  EXPECT_EQ(palpate({"demo", "-o", folder / "tour"}, kHeadless).exitCode, 0);
  EXPECT_EQ(palpate({"demo", "-o", folder / "tour"}, kHeadless).exitCode, 0);
  EXPECT_TRUE(fs::is_empty(folder / "tour"));
  EXPECT_TRUE(fs::exists(folder / "tour-2" / "report.json"));
  EXPECT_TRUE(fs::exists(folder / "tour-3" / "report.json"));
}

TEST(DemoCommand, SaysWhatFailed) {
  expectOneLineError(palpate({"demo", "-o", "/nowhere/tour"}, kHeadless), 1, {"/nowhere/tour"});
  const testing::TemporaryFolder folder;
  auto environment = kHeadless;
  environment["PALPATE_DATA"] = folder / "nothing";
  const auto result = palpate({"demo", "-o", folder / "tour"}, environment);
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.out.find("read: failed, "), std::string::npos) << result.out;
  EXPECT_TRUE(fs::exists(folder / "tour" / "report.json"));
}

}  // namespace
}  // namespace palpate

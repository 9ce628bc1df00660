#include "commands/palpate_program.h"

namespace palpate {
namespace {

using testing::expectOneLineError;
using testing::palpate;

const std::map<std::string, std::string> kHeadless = {
    {"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}, {"QT_QPA_PLATFORM", ""}};

// Width and height from a PNG's header.
std::pair<unsigned, unsigned> pngSize(const std::filesystem::path& file) {
  const std::string bytes = testing::readFile(file);
  if (bytes.size() < 24 || bytes.substr(1, 3) != "PNG") return {0, 0};
  const auto big = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = 0; i < 4; ++i)
      value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
  };
  return {big(16), big(20)};
}

std::string demoFile() { return testing::dataFolder() / "demo_grasps.dsa"; }

TEST(WorkbenchCommand, WithoutADisplayItSaysSoInOneLine) {
  expectOneLineError(palpate({}, kHeadless), 1, {"no display"});
  expectOneLineError(palpate({"--demo"}, kHeadless), 1, {"no display"});
  expectOneLineError(palpate({demoFile()}, kHeadless), 1, {"no display"});
  auto dead = kHeadless;
  dead["DISPLAY"] = ":4711";  // a display that doesn't answer
  expectOneLineError(palpate({}, dead), 1, {"no display"});
}

TEST(WorkbenchCommand, ScreenshotShowsTheWindowWithoutADisplay) {
  const testing::TemporaryFolder folder;
  const auto result = palpate({"--screenshot",
                               folder / "w.png",
                               "--size",
                               "1280x800",
                               "--frame",
                               "100",
                               "--theme",
                               "light",
                               demoFile()},
                              kHeadless);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(pngSize(folder / "w.png"), std::pair(1280u, 800u));
}

TEST(WorkbenchCommand, ScreenshotOfDemoAndOfTheStartPage) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(
      palpate({"--screenshot", folder / "d.png", "--demo", "--after", "0.5"}, kHeadless).exitCode,
      0);
  EXPECT_EQ(palpate({"--screenshot", folder / "s.png"}, kHeadless).exitCode, 0);
  EXPECT_EQ(pngSize(folder / "d.png"), std::pair(1600u, 1000u));
  EXPECT_NE(testing::readFile(folder / "d.png"), testing::readFile(folder / "s.png"));
}

TEST(WorkbenchCommand, ScreenshotRefusesBadInput) {
  const testing::TemporaryFolder folder;
  const std::string out = folder / "w.png";
  const auto shot = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"--screenshot", out});
    return palpate(more, kHeadless);
  };
  expectOneLineError(shot({"--size", "12x"}), 2, {"--size"});
  expectOneLineError(shot({"--size", "99999x99999"}), 2, {"--size"});
  expectOneLineError(shot({"--theme", "pink"}), 2, {"dark, light"});
  expectOneLineError(shot({"--frame", "99999999", demoFile()}), 1, {"99999999"});
  expectOneLineError(shot({"--dock", "Nonsense", demoFile()}), 1, {"Nonsense", "Inspect"});
  expectOneLineError(shot({folder / "missing.dsa"}), 1, {"missing.dsa"});
  expectOneLineError(shot({"--demo", demoFile()}), 2, {"--demo"});
  expectOneLineError(palpate({"--size", "800x600"}, kHeadless), 2, {"--screenshot"});
  EXPECT_FALSE(std::filesystem::exists(out));
  testing::writeFile(out, "precious");
  expectOneLineError(shot({demoFile()}), 1, {"w.png", "--force"});
  EXPECT_EQ(testing::readFile(out), "precious");
}

}  // namespace
}  // namespace palpate

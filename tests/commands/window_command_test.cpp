#include <csignal>

#include "commands/palpate_program.h"
#include "testing/awaited.h"
#include "testing/background_program.h"

namespace palpate::window_command_test {
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

TEST(WorkbenchCommand, WhatMakesNoSenseIsSaidBeforeAnyDisplayIsAskedFor) {
  expectOneLineError(palpate({"--gl", "--no-gl"}), 2, {"--gl", "--no-gl"});
  expectOneLineError(palpate({"--angles", "1,2", demoFile()}), 2, {"--angles", "7"});
  expectOneLineError(palpate({"--angles", "0,inf,0,0,0,0,0", demoFile()}), 2, {"--angles"});
}

TEST(WorkbenchCommand, PlatformsThatDoNotAnswerAreNoDisplayEither) {
  auto wayland = kHeadless;
  wayland["WAYLAND_DISPLAY"] = "no-compositor";
  expectOneLineError(palpate({demoFile()}, wayland), 1, {"no display"});
  auto bogus = kHeadless;
  bogus["QT_QPA_PLATFORM"] = "bogus";
  expectOneLineError(palpate({demoFile()}, bogus), 1, {"no display"});
  const testing::TemporaryFolder folder;
  for (const auto& environment : {wayland, bogus}) {
    const auto result =
        palpate({"--screenshot", folder / "w.png", "--force", demoFile()}, environment);
    EXPECT_EQ(result.exitCode, 0) << result.err;
  }
}

// What the window asks another process, because drivers crash.
TEST(WorkbenchCommand, TheOpenGlProbeSaysWhyThereIsNone) {
  const auto headless = palpate({"--probe-opengl"}, kHeadless);
  EXPECT_EQ(headless.exitCode, 1);
  EXPECT_EQ(headless.out, "there is no display\n");
  auto memory = kHeadless;
  memory["QT_QPA_PLATFORM"] = "offscreen";
  const auto offscreen = palpate({"--probe-opengl"}, memory);
  EXPECT_EQ(offscreen.exitCode, 1);
  EXPECT_EQ(offscreen.out, "the platform \"offscreen\" has no OpenGL\n");
  const auto here = palpate({"--probe-opengl"});  // whatever there is
  EXPECT_EQ(here.exitCode == 0, here.out.empty()) << here.exitCode << ": " << here.out;
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
  expectOneLineError(shot({"--frame", "5"}), 2, {"--frame"});
  expectOneLineError(palpate({"--screenshot", folder / "w.jpg", demoFile()}), 2, {".png"});
  expectOneLineError(palpate({"--demo", demoFile()}, kHeadless), 2, {"--demo"});
  expectOneLineError(shot({"--frame", "99999999", demoFile()}), 1, {"99999999"});
  expectOneLineError(shot({"--dock", "Nonsense", demoFile()}), 1, {"Nonsense", "Inspect"});
  expectOneLineError(
      shot({"--dock", "Hand/Nonsense", demoFile()}), 1, {"Nonsense", "Grasp, Joints"});
  expectOneLineError(shot({"--dock", "Inspect/Grasp", demoFile()}), 1, {"Inspect has no pages"});
  expectOneLineError(shot({folder / "missing.dsa"}), 1, {"missing.dsa"});
  expectOneLineError(shot({"--demo", demoFile()}), 2, {"--demo"});
  expectOneLineError(palpate({"--size", "800x600"}, kHeadless), 2, {"--screenshot"});
  EXPECT_FALSE(std::filesystem::exists(out));
  testing::writeFile(out, "precious");
  expectOneLineError(shot({demoFile()}), 1, {"w.png", "--force"});
  EXPECT_EQ(testing::readFile(out), "precious");
}

// Ctrl-C in the terminal that it was started from: settings are kept, and nobody was killed.
TEST(WorkbenchCommand, AskedToEndItEndsInOrder) {
  const testing::TemporaryFolder home;
  const auto settings = home / "palpate/palpate.ini";
  ::setenv("QT_QPA_PLATFORM", "offscreen", 1);
  ::setenv("XDG_CONFIG_HOME", home.path().c_str(), 1);
  for (const int number : {SIGINT, SIGTERM}) {
    testing::BackgroundProgram program(PALPATE_PROGRAM, {"--demo"});
    // It remembers what it is connected to: so long it needs to stand.
    ASSERT_TRUE(testing::awaited([&] { return std::filesystem::exists(settings); }))
        << program.err();
    std::filesystem::remove(settings);
    program.signal(number);
    EXPECT_EQ(program.wait(), 0) << program.err();
    EXPECT_TRUE(std::filesystem::exists(settings)) << number;
    std::filesystem::remove(settings);
  }
  ::unsetenv("QT_QPA_PLATFORM");
  ::unsetenv("XDG_CONFIG_HOME");
}

}  // namespace
}  // namespace palpate::window_command_test

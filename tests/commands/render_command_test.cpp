#include "commands/palpate_program.h"

namespace palpate {
namespace {

using testing::expectOneLineError;
using testing::palpate;

const std::map<std::string, std::string> kHeadless = {
    {"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}, {"QT_QPA_PLATFORM", ""}};

std::string demoFile() { return testing::dataFolder() / "demo_grasps.dsa"; }

TEST(RenderCommand, WritesTheFormOfTheEnding) {
  const testing::TemporaryFolder folder;
  for (const char* name : {"a.png", "a.svg", "a.pdf"}) {
    const auto result =
        palpate({"render", demoFile(), "--frame", "90", "-o", folder / name}, kHeadless);
    EXPECT_EQ(result.exitCode, 0) << name << result.err;
  }
  EXPECT_EQ(testing::readFile(folder / "a.png").substr(1, 3), "PNG");
  EXPECT_EQ(testing::readFile(folder / "a.pdf").substr(0, 5), "%PDF-");
  const std::string svg = testing::readFile(folder / "a.svg");
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("finger 0"), std::string::npos);  // text stays text
}

TEST(RenderCommand, TheFrameMakesTheDifference) {
  const testing::TemporaryFolder folder;
  palpate({"render", demoFile(), "--frame", "0", "-o", folder / "a.png"}, kHeadless);
  palpate({"render", demoFile(), "--frame", "90", "-o", folder / "b.png"}, kHeadless);
  palpate({"render", demoFile(), "--frame", "0", "-o", folder / "c.png"}, kHeadless);
  EXPECT_NE(testing::readFile(folder / "a.png"), testing::readFile(folder / "b.png"));
  EXPECT_EQ(testing::readFile(folder / "a.png").size(), testing::readFile(folder / "c.png").size());
}

TEST(RenderCommand, RefusesBadInputAndLeavesNothing) {
  const testing::TemporaryFolder folder;
  const std::string out = folder / "a.png";
  expectOneLineError(palpate({"render", demoFile(), "--frame", "761", "-o", out}, kHeadless),
                     1,
                     {"no frame 761", "0..760"});
  expectOneLineError(palpate({"render", demoFile(), "-o", folder / "a.gif"}, kHeadless),
                     2,
                     {".png, .svg or .pdf"});
  expectOneLineError(palpate({"render", demoFile()}, kHeadless), 2, {"-o"});
  expectOneLineError(
      palpate({"render", demoFile(), "-o", out, "--view", "hat"}, kHeadless), 2, {"matrices"});
  expectOneLineError(
      palpate({"render", folder / "missing.dsa", "-o", out}, kHeadless), 1, {"missing.dsa"});
  EXPECT_FALSE(std::filesystem::exists(out));
  testing::writeFile(out, "precious");
  expectOneLineError(palpate({"render", demoFile(), "-o", out}, kHeadless), 1, {"--force"});
  EXPECT_EQ(testing::readFile(out), "precious");
  EXPECT_EQ(palpate({"render", demoFile(), "-o", out, "--force"}, kHeadless).exitCode, 0);
}

}  // namespace
}  // namespace palpate

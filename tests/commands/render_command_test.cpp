#include <csignal>
#include <set>

#include "palpate/core/number_text.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"
#include "testing/awaited.h"
#include "testing/background_program.h"

namespace palpate::render_command_test {
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

// Colours in an SVG's heat maps: how many different fills there are.
std::size_t numFills(const std::filesystem::path& file) {
  const std::string svg = testing::readFile(file);
  std::set<std::string> fills;
  for (auto at = svg.find("fill=\"#"); at != std::string::npos; at = svg.find("fill=\"#", at + 1))
    fills.insert(svg.substr(at + 6, 7));
  return fills.size();
}

TEST(RenderCommand, TheFrameMakesTheDifference) {
  const testing::TemporaryFolder folder;
  for (const auto& [frame, name] :
       {std::pair{"0", "empty.svg"}, {"90", "grasp.svg"}, {"0", "again.svg"}})
    ASSERT_EQ(
        palpate({"render", demoFile(), "--frame", frame, "-o", folder / name}, kHeadless).exitCode,
        0);
  // A grasp on two fingertips has dozens of colours; an empty frame has none but those around it.
  EXPECT_GT(numFills(folder / "grasp.svg"), numFills(folder / "empty.svg") + 20);
  EXPECT_EQ(testing::readFile(folder / "empty.svg"), testing::readFile(folder / "again.svg"));
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

// Big-endian number of four bytes within a PNG.
std::uint32_t numberAt(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

struct PngFacts {
  std::uint32_t width = 0;   // [px]
  std::uint32_t height = 0;  // [px]
  std::uint32_t perMetre = 0;
};
// From the chunks IHDR (at a fixed place) and pHYs (PNG specification, 11.2.2 and 11.3.5.3).
PngFacts factsOf(const std::filesystem::path& file) {
  const std::string png = testing::readFile(file);
  PngFacts facts{.width = numberAt(png, 16), .height = numberAt(png, 20)};
  const auto at = png.find("pHYs");
  if (at != std::string::npos && png.at(at + 12) == 1) facts.perMetre = numberAt(png, at + 4);
  return facts;
}

TEST(RenderCommand, PaperHasMillimetresAndDotsPerInch) {
  const testing::TemporaryFolder folder;
  const auto draw = [&](const std::string& out, std::vector<std::string> more) {
    std::vector<std::string> words = {"render", demoFile(), "--frame", "90", "-o", folder / out};
    words.insert(words.end(), more.begin(), more.end());
    const auto result = palpate(words, kHeadless);
    EXPECT_EQ(result.exitCode, 0) << result.err;
  };
  draw("a.png", {"--width-mm", "85", "--height-mm", "60", "--dpi", "600"});
  const PngFacts png = factsOf(folder / "a.png");
  EXPECT_EQ(png.width, 2008u);   // 85 / 25.4 * 600 = 2007.9
  EXPECT_EQ(png.height, 1417u);  // 60 / 25.4 * 600 = 1417.3
  EXPECT_EQ(png.perMetre, 23622u);
  draw("b.png", {"--print"});
  EXPECT_EQ(factsOf(folder / "b.png").width, 2055u);  // 174 / 25.4 * 300 = 2055.1
  EXPECT_EQ(factsOf(folder / "b.png").perMetre, 11811u);
  draw("c.png", {"--size", "400x400", "--dpi", "96"});
  EXPECT_EQ(factsOf(folder / "c.png").width, 400u);
  draw("a.svg", {"--width-mm", "85", "--height-mm", "60", "--text-pt", "7"});
  const std::string svg = testing::readFile(folder / "a.svg");
  EXPECT_NE(svg.find("width=\"85mm\" height=\"60mm\""), std::string::npos) << svg.substr(0, 300);
  // 7 pt in units of which 144 are an inch.
  EXPECT_NE(svg.find("font-size=\"14\""), std::string::npos);
  draw("a.pdf", {"--width-mm", "114", "--height-mm", "100"});
  const std::string pdf = testing::readFile(folder / "a.pdf");
  EXPECT_NE(pdf.find("/MediaBox [0 0 323"), std::string::npos);  // 114 / 25.4 * 72 = 323.1
}

TEST(RenderCommand, ASeriesHasBothEndsAndOneRangeOfColours) {
  const testing::TemporaryFolder folder;
  const auto out = folder / "pictures";
  const auto result = palpate({"render",
                               demoFile(),
                               "--from",
                               "40",
                               "--to",
                               "49",
                               "-o",
                               out.string() + "/",
                               "--size",
                               "320x320",
                               "--dpi",
                               "96"},
                              kHeadless);
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.out.find("10 pictures, frames 40..49"), std::string::npos) << result.out;
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(out))
    names.insert(entry.path().filename().string());
  ASSERT_EQ(names.size(), 10u);
  EXPECT_EQ(*names.begin(), "demo_grasps_00040.png");
  EXPECT_EQ(*names.rbegin(), "demo_grasps_00049.png");
  EXPECT_EQ(factsOf(out / "demo_grasps_00045.png").width, 320u);
  const auto refused =
      palpate({"render", demoFile(), "--from", "45", "--to", "60", "-o", out, "--size", "320x320"},
              kHeadless);
  expectOneLineError(refused, 1, {"5 of these 16", "--force"});
  EXPECT_FALSE(std::filesystem::exists(out / "demo_grasps_00050.png"));
}

TEST(RenderCommand, RefusesSeriesThatMakeNoSense) {
  const testing::TemporaryFolder folder;
  const std::string out = folder / "pictures";
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"render", demoFile()});
    return palpate(words, kHeadless);
  };
  expectOneLineError(with({"--from", "700", "--to", "761", "-o", out}), 1, {"700..761", "0..760"});
  expectOneLineError(with({"--from", "9", "--to", "8", "-o", out}), 2, {"--from is after --to"});
  expectOneLineError(with({"--from", "9", "-o", folder / "a.png"}), 2, {"folder", ".mp4"});
  for (const char* option : {"--speed", "--fps"})
    expectOneLineError(with({option, "2", "-o", folder / "a.png"}), 2, {option, ".mp4"});
  expectOneLineError(with({"--from", "9", "--frame", "9", "-o", out}), 2, {"--frame"});
  expectOneLineError(with({"--print", "--size", "400x400", "-o", folder / "a.png"}), 2, {"--size"});
  expectOneLineError(with({"--print", "--theme", "dark", "-o", folder / "a.png"}), 2, {"--print"});
  expectOneLineError(
      with({"--width-mm", "1000", "--dpi", "2400", "-o", folder / "a.png"}), 2, {"pixels"});
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  testing::writeFile(folder / "file", "precious");
  expectOneLineError(with({"--from", "9", "--to", "9", "-o", folder / "file"}), 1, {"file"});
  EXPECT_EQ(testing::readFile(folder / "file"), "precious");
}

TEST(RenderCommand, AnInterruptedSeriesLeavesWholePictures) {
  const testing::TemporaryFolder folder;
  const auto out = folder / "pictures";
  testing::BackgroundProgram program(PALPATE_PROGRAM,
                                     {"render", demoFile(), "--from", "0", "-o", out, "--print"});
  EXPECT_TRUE(
      testing::awaited([&] { return std::filesystem::exists(out / "demo_grasps_00002.png"); }));
  program.signal(SIGINT);
  EXPECT_EQ(program.wait(), 3);
  EXPECT_NE(program.err().find("interrupted: "), std::string::npos) << program.err();
  std::size_t pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    ++pictures;
    const std::string png = testing::readFile(entry.path());
    ASSERT_GT(png.size(), 12u);
    // Each ends with the chunk IEND and its check sum.
    EXPECT_EQ(png.substr(png.size() - 8, 4), "IEND") << entry.path();
  }
  EXPECT_GE(pictures, 3u);
  EXPECT_LT(pictures, 761u);
  EXPECT_NE(program.err().find(std::to_string(pictures) + " of 761"), std::string::npos)
      << program.err();
}

TEST(RenderCommand, APictureOfEachRecording) {
  namespace fs = std::filesystem;
  const testing::TemporaryFolder folder;
  fs::create_directories(folder / "in/deep");
  for (const char* name : {"in/a.dsa", "in/b.dsa", "in/deep/c.dsa"})
    fs::copy_file(demoFile(), folder / name);
  testing::writeFile(folder / "in/bad.dsa", "hello");
  const std::vector<std::vector<std::string>> looks = {
      {"--values", "--theme", "dark"}, {"--frame", "90", "--view", "hand", "--size", "400x400"}};
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const auto words = [&](const fs::path& in, const fs::path& out) {
      std::vector<std::string> all = {"render", in.string(), "-o", out.string()};
      all.insert(all.end(), looks[i].begin(), looks[i].end());
      return all;
    };
    const fs::path out = folder / ("out" + std::to_string(i));
    const auto result = palpate(words(folder / "in", out / "{name}.png"), kHeadless);
    EXPECT_EQ(result.exitCode, 3) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find("bad.dsa: "), std::string::npos) << result.err;
    EXPECT_NE(result.out.find("done               3\n"), std::string::npos) << result.out;
    const fs::path one = folder / ("one" + std::to_string(i));
    fs::create_directories(one);
    ASSERT_EQ(palpate(words(folder / "in/deep/c.dsa", one / "c.png"), kHeadless).exitCode, 0);
    EXPECT_TRUE(testing::readFile(out / "deep/c.png") == testing::readFile(one / "c.png"));
    auto resumed = words(folder / "in", out / "{name}.png");
    resumed.emplace_back("--resume");
    EXPECT_NE(palpate(resumed, kHeadless).out.find("skipped            3\n"), std::string::npos);
    resumed.insert(resumed.end(), {"--dpi", "96"});
    EXPECT_NE(palpate(resumed, kHeadless).out.find("done               3\n"), std::string::npos);
  }
  const std::string in = folder / "in";
  expectOneLineError(
      palpate({"render", in, "-o", folder / "{name}.gif"}, kHeadless), 2, {".png, .svg or .pdf"});
  expectOneLineError(palpate({"render", in, "--from", "3", "-o", folder / "{name}.png"}, kHeadless),
                     2,
                     {"--frame"});
  expectOneLineError(palpate({"render", demoFile(), "--resume", "-o", folder / "x.png"}, kHeadless),
                     2,
                     {"-o TEMPLATE"});
  expectOneLineError(
      palpate({"render", in, "-o", folder / "out/x.png"}, kHeadless), 1, {"from both"});
}

}  // namespace
}  // namespace palpate::render_command_test

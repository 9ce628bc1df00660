// palpate render --view hand, by the real program and without a display.
#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/dsa_writer.h"

#include "commands/palpate_program.h"
#include "testing/testing.h"

namespace palpate::render_hand_test {
namespace {

using testing::expectOneLineError;
using testing::palpate;

const std::map<std::string, std::string> kHeadless = {
    {"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}, {"QT_QPA_PLATFORM", ""}};

std::string demoFile() { return testing::dataFolder() / "demo_grasps.dsa"; }

class RenderHandTest : public ::testing::Test {
 protected:
  testing::ProgramResult draw(const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> words = {
        "render", demoFile(), "--view", "hand", "--frame", "90", "-o", folder_ / name};
    words.insert(words.end(), more.begin(), more.end());
    return palpate(words, kHeadless);
  }
  std::string bytes(const std::string& name) { return testing::readFile(folder_ / name); }

  testing::TemporaryFolder folder_;
};

TEST_F(RenderHandTest, DrawsTheHandInEveryForm) {
  for (const char* name : {"a.png", "a.svg", "a.pdf"})
    EXPECT_EQ(draw(name, {"--size", "400x320"}).exitCode, 0) << name;
  EXPECT_EQ(bytes("a.png").substr(1, 3), "PNG");
  EXPECT_NE(bytes("a.svg").find("demo_grasps.dsa"), std::string::npos);  // words stay words
  EXPECT_NE(bytes("a.svg").find("enclosing sphere"), std::string::npos);
  EXPECT_EQ(bytes("a.pdf").substr(0, 5), "%PDF-");
}

TEST_F(RenderHandTest, EveryOptionChangesThePicture) {
  const std::vector<std::string> small = {"--size", "400x320"};
  ASSERT_EQ(draw("usual.png", small).exitCode, 0);
  ASSERT_EQ(draw("again.png", small).exitCode, 0);
  EXPECT_EQ(bytes("usual.png"), bytes("again.png"));
  const std::vector<std::vector<std::string>> others = {{"--taxels", "bars"},
                                                        {"--taxels", "points"},
                                                        {"--taxels", "flat-cells"},
                                                        {"--sphere", "wire"},
                                                        {"--sphere", "opaque"},
                                                        {"--sphere", "no-sphere"},
                                                        {"--sphere-of", "centroids"},
                                                        {"--matrix", "1"},
                                                        {"--camera", "40,30"},
                                                        {"--normals"},
                                                        {"--no-contacts"},
                                                        {"--wire"},
                                                        {"--axes"},
                                                        {"--theme", "dark"},
                                                        {"--map", "viridis"}};
  for (std::size_t i = 0; i < others.size(); ++i) {
    std::vector<std::string> more = small;
    more.insert(more.end(), others[i].begin(), others[i].end());
    const std::string name = std::to_string(i) + ".png";
    ASSERT_EQ(draw(name, more).exitCode, 0) << others[i][0];
    EXPECT_NE(bytes(name), bytes("usual.png")) << others[i][0] << " " << others[i].back();
  }
}

TEST_F(RenderHandTest, WithoutAnglesItSaysSoOrAssumesThem) {
  const std::string file = folder_ / "bare.dsa";
  ProfileBuilder builder(sdh2().layout);
  TactileFrame frame(sdh2().layout);
  frame.matrix(1)(4, 2) = 100.0F;
  for (int i = 0; i < 3; ++i) builder.addFrame(1'400'000'000'000'000 + i * 30'000, frame.values);
  writeDsa(builder.finish({}), file);
  const auto render = [&](const std::string& out, std::vector<std::string> more) {
    std::vector<std::string> words = {
        "render", file, "--view", "hand", "--size", "400x320", "-o", folder_ / out};
    words.insert(words.end(), more.begin(), more.end());
    return palpate(words, kHeadless).exitCode;
  };
  ASSERT_EQ(render("rest.svg", {}), 0);
  EXPECT_NE(bytes("rest.svg").find("No usable joint angles"), std::string::npos);
  ASSERT_EQ(render("posed.svg", {"--angles", "0,-10,20,-10,20,-10,20"}), 0);
  EXPECT_NE(bytes("posed.svg").find("are assumed"), std::string::npos);
}

TEST_F(RenderHandTest, RefusesWhatMakesNoSense) {
  expectOneLineError(draw("a.png", {"--taxels", "balls"}), 2, {"taxels", "balls"});
  expectOneLineError(draw("a.png", {"--sphere", "cube"}), 2, {"sphere"});
  expectOneLineError(draw("a.png", {"--matrix", "6"}), 1, {"no matrix 6", "0..5"});
  expectOneLineError(draw("a.png", {"--camera", "10"}), 2, {"camera", "2"});
  expectOneLineError(draw("a.png", {"--camera", "10,95"}), 2, {"camera", "89"});
  expectOneLineError(draw("a.png", {"--angles", "1,2"}), 2, {"angles", "7"});
  expectOneLineError(draw("a.png", {"--angles", "0,nan,0,0,0,0,0"}), 2, {"angles"});
  expectOneLineError(draw("a.png", {"--angles", "0,500,0,0,0,0,0"}), 2, {"angles"});
  expectOneLineError(draw("a.png", {"--values"}), 2, {"heat maps"});
  expectOneLineError(palpate({"render", demoFile(), "--wire", "-o", folder_ / "a.png"}, kHeadless),
                     2,
                     {"--wire", "--view hand"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.png"));
}

TEST_F(RenderHandTest, ASeriesHasAPictureOfEachFrame) {
  const auto result = palpate({"render",
                               demoFile(),
                               "--view",
                               "hand",
                               "--from",
                               "80",
                               "--to",
                               "82",
                               "--size",
                               "400x320",
                               "-o",
                               folder_ / "series"},
                              kHeadless);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  for (const char* name :
       {"demo_grasps_00080.png", "demo_grasps_00081.png", "demo_grasps_00082.png"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "series" / name)) << name;
}

// Beside each other, with one title and one colour bar.
TEST_F(RenderHandTest, BothViewsSideBySide) {
  const auto drawn = [&](const char* name, const char* view, const char* size) {
    const auto result = palpate({"render",
                                 demoFile(),
                                 "--view",
                                 view,
                                 "--frame",
                                 "90",
                                 "--size",
                                 size,
                                 "-o",
                                 folder_ / name},
                                kHeadless);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return bytes(name);
  };
  const std::string both = drawn("both.svg", "both", "800x400");
  const std::string matrices = drawn("matrices.svg", "matrices", "400x400");
  const std::string hand = drawn("hand.svg", "hand", "400x400");
  EXPECT_GT(both.size(), std::max(matrices.size(), hand.size()));
  EXPECT_NE(both, matrices);
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  };
  for (const char* once : {">demo_grasps.dsa</text>", ">frame 90 ", ">counts<"}) {
    EXPECT_EQ(count(matrices, once), 1u) << once;
    EXPECT_EQ(count(hand, once), 1u) << once;
    EXPECT_EQ(count(both, once), 1u) << once;
  }
  EXPECT_EQ(draw("x.png", {"--view", "all"}).exitCode, 2);
}

}  // namespace
}  // namespace palpate::render_hand_test

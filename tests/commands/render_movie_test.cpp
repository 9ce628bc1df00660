// palpate render .. -o OUT.mp4, with a program in ffmpeg's place that keeps what it is given.
#include <csignal>

#include "commands/palpate_program.h"
#include "testing/awaited.h"
#include "testing/background_program.h"
#include "testing/fake_ffmpeg.h"

namespace palpate::render_movie_test {
namespace {

using testing::expectOneLineError;
using testing::FakeFfmpeg;
namespace fs = std::filesystem;

class RenderMovieTest : public ::testing::Test {
 protected:
  std::vector<std::string> words(const std::vector<std::string>& more) const {
    std::vector<std::string> all = {
        "render", testing::dataFolder() / "demo_grasps.dsa", "-o", out_, "--size", "320x320"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  testing::ProgramResult render(const std::vector<std::string>& more) const {
    return testing::palpate(words(more),
                            {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}, {"QT_QPA_PLATFORM", ""}});
  }
  static double numPictures(const FakeFfmpeg& fake) {
    return static_cast<double>(fs::file_size(fake.file("pixels"))) / (320.0 * 320.0 * 4.0);
  }

  testing::TemporaryFolder folder_;
  fs::path out_ = folder_ / "out 'of' it.MP4";
};

// demo_grasps.dsa has a frame each 31 or 32 ms: frames 40..99 take 60 / 31.7 = 1.89 s.
TEST_F(RenderMovieTest, TakesAsLongAsTheFramesDid) {
  const FakeFfmpeg fake;
  const auto result = render({"--from", "40", "--to", "99"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(testing::readFile(out_), "whole");
  EXPECT_NE(result.out.find("frames 40..99"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("1.9 s"), std::string::npos) << result.out;
  EXPECT_NEAR(numPictures(fake), 1.89 * 30, 1.0);
  EXPECT_EQ(fake.wordAfter("-s"), "320x320") << "as many pixels as asked for";
  EXPECT_EQ(fake.wordAfter("-r"), "30");
}

TEST_F(RenderMovieTest, SpeedAndPicturesPerSecond) {
  const FakeFfmpeg fake;
  ASSERT_EQ(render({"--from", "40", "--to", "99", "--speed", "4", "--fps", "25"}).exitCode, 0);
  EXPECT_NEAR(numPictures(fake), 1.89 * 25 / 4, 1.5);  // one more for the last frame
  EXPECT_EQ(fake.wordAfter("-r"), "25");
  fs::remove(out_);
  ASSERT_EQ(render({"--to", "9", "--speed", "0.25", "--fps", "10", "--dpi", "192"}).exitCode, 0);
  EXPECT_EQ(fake.wordAfter("-s"), "640x640");
}

TEST_F(RenderMovieTest, RefusesBadInputAndLeavesNothing) {
  const FakeFfmpeg fake;
  expectOneLineError(render({"--frame", "9"}), 2, {"--frame"});
  expectOneLineError(render({"--speed", "0"}), 2, {"--speed"});
  expectOneLineError(render({"--fps", "121"}), 2, {"--fps"});
  expectOneLineError(render({"--from", "9", "--to", "761"}), 1, {"0..760"});
  EXPECT_FALSE(fs::exists(out_));
  testing::writeFile(out_, "precious");
  expectOneLineError(render({"--to", "9"}), 1, {"--force"});
  EXPECT_EQ(testing::readFile(out_), "precious");
  EXPECT_FALSE(fake.wasCalled());
  EXPECT_EQ(render({"--to", "9", "--force"}).exitCode, 0);
  EXPECT_EQ(testing::readFile(out_), "whole");
}

TEST_F(RenderMovieTest, FfmpegThatFailsOrIsMissingIsSaidInOneLine) {
  {
    const FakeFfmpeg fake(
        "head -c 5000 > /dev/null; echo first >&2; echo 'Unknown thing' >&2; exit 1");
    expectOneLineError(render({"--to", "9"}), 1, {"Unknown thing", out_.filename().string()});
  }
  const auto without = [&](const std::string& variable) {
    return testing::palpate(words({"--to", "9"}),
                            {{"PALPATE_FFMPEG", variable}, {"PATH", folder_.path().string()}});
  };
  expectOneLineError(without("/no/such/ffmpeg"), 1, {"/no/such/ffmpeg"});
  expectOneLineError(without(""), 1, {"apt install ffmpeg", "PNG"});
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(RenderMovieTest, InterruptedItLeavesNothing) {
  const FakeFfmpeg fake("sleep 1000");
  testing::BackgroundProgram program(PALPATE_PROGRAM, words({"--to", "99"}));
  EXPECT_TRUE(testing::awaited([&] { return fake.wasCalled(); }));
  program.signal(SIGINT);
  EXPECT_EQ(program.wait(), 3);
  EXPECT_NE(program.err().find("interrupted: "), std::string::npos) << program.err();
  EXPECT_TRUE(fs::is_empty(folder_.path()));
  EXPECT_FALSE(fake.runs("pid"));
}

TEST_F(RenderMovieTest, AMovieOfEachRecording) {
  const FakeFfmpeg fake;
  fs::create_directories(folder_ / "in");
  for (const char* name : {"in/a.dsa", "in/b.dsa"})
    fs::copy_file(testing::dataFolder() / "demo_grasps.dsa", folder_ / name);
  const auto result =
      testing::palpate({"render",
                        folder_ / "in",
                        "--from",
                        "40",
                        "--to",
                        "49",
                        "-o",
                        folder_ / "out/{name}.mp4",
                        "--threads",
                        "1"},
                       {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}, {"QT_QPA_PLATFORM", ""}});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.out.find("b.mp4: 10 frames\n"), std::string::npos) << result.out;
  for (const char* name : {"out/a.mp4", "out/b.mp4"})
    EXPECT_EQ(testing::readFile(folder_ / name), "whole");
}

}  // namespace
}  // namespace palpate::render_movie_test

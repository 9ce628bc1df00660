#include "gui/picture/movie_writer.h"

#include <QPainter>
#include <algorithm>
#include <cstdlib>

#include <palpate/core/child_program.h>
#include <palpate/core/error.h>

#include "gui/picture/ffmpeg.h"
#include "testing/fake_ffmpeg.h"

namespace palpate::gui::movie_writer_test {
namespace {

using testing::FakeFfmpeg;

namespace fs = std::filesystem;

class MovieWriterTest : public ::testing::Test {
 protected:
  // Frame n is of red n.
  FramePictures::Paint paint() {
    return [this](QPainter& painter, std::size_t frame) {
      painted_.push_back(frame);
      painter.fillRect(QRectF(0, 0, 100, 100), QColor(static_cast<int>(frame), 0, 0));
    };
  }
  static Movie movie(std::vector<MovieFrame> shots, std::size_t first = 0) {
    Movie movie{.frames = {first, first + shots.back().frame},
                .timing = {.shots = std::move(shots)},
                .picturesPerS = 25.0};
    for (const MovieFrame& shot : movie.timing.shots) movie.timing.numPictures += shot.numPictures;
    return movie;
  }
  std::string failure(Overwrite overwrite = Overwrite::kRefuse) {
    try {
      writeMovie(path_, movie({{0, 2}, {1, 200}}), paint(), paper_, overwrite);
    } catch (const FileError& error) {
      return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
  }
  std::size_t numFiles() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }
  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }
  testing::TemporaryFolder folder_;
  fs::path path_ = folder_ / "a movie 'of' $(it) %03d.mp4";
  PicturePaper paper_{.size = {40, 30}, .unitsPerInch = 96.0, .dpi = 96.0};
  std::vector<std::size_t> painted_;
};

TEST_F(MovieWriterTest, EachPictureIsTheFrameOfItsMomentPaintedOnce) {
  const FakeFfmpeg fake;
  writeMovie(path_, movie({{0, 2}, {3, 1}, {4, 3}}, 100), paint(), paper_);
  EXPECT_EQ(testing::readFile(path_), "whole");
  EXPECT_EQ(numFiles(), 1u);
  EXPECT_EQ(painted_, (std::vector<std::size_t>{100, 103, 104}));
  const std::string pixels = testing::readFile(fake.file("pixels"));
  constexpr std::size_t kPicture = 40 * 30 * 4;
  const std::vector<int> expected = {100, 100, 103, 104, 104, 104};
  ASSERT_EQ(pixels.size(), expected.size() * kPicture);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto at = [&](std::size_t byte) {
      return static_cast<int>(static_cast<unsigned char>(pixels[i * kPicture + byte]));
    };
    EXPECT_EQ(at(2), expected[i]) << "blue, green, red, none; picture " << i;
    EXPECT_EQ(at(0) + at(1), 0);
    EXPECT_EQ(at(kPicture - 2), expected[i]) << "to the last pixel";
  }
}

TEST_F(MovieWriterTest, SidesAreMadeEvenByGroundNotByScaling) {
  const FakeFfmpeg fake;
  paper_.size = {41, 31};
  paper_.background = Qt::white;
  EXPECT_EQ(moviePixels(paper_), QSize(42, 32));
  const auto frame = [](QPainter& painter, std::size_t) {
    painter.fillRect(QRectF(0, 0, 41, 31), Qt::black);
  };
  writeMovie(path_, movie({{0, 1}}), frame, paper_);
  EXPECT_EQ(fake.wordAfter("-s"), "42x32");
  const std::string pixels = testing::readFile(fake.file("pixels"));
  ASSERT_EQ(pixels.size(), 42u * 32u * 4u);
  EXPECT_EQ(pixels[40 * 4], '\0');
  EXPECT_EQ(pixels[41 * 4], '\xff') << "the added column";
  EXPECT_EQ(pixels[31 * 42 * 4], '\xff') << "the added row";
}

TEST_F(MovieWriterTest, TellsRateTitleAndEncoder) {
  const FakeFfmpeg fake(FakeFfmpeg::kGood, " V.S..D mpeg4  x\\n");
  paper_.title = "ball; rm -rf 'x' \"ü\"";
  writeMovie(path_, movie({{0, 1}}), paint(), paper_);
  EXPECT_EQ(fake.wordAfter("-r"), "25");
  EXPECT_EQ(fake.wordAfter("-c:v"), "mpeg4");
  EXPECT_EQ(fake.wordAfter("-metadata"), "title=ball; rm -rf 'x' \"ü\"");
}

TEST_F(MovieWriterTest, ItsOwnLastWordIsInTheMessageAndNothingIsLeft) {
  const FakeFfmpeg fake("echo Unknown colours >&2; echo 'Conversion failed!' >&2; exit 1");
  const std::string said = failure();
  EXPECT_TRUE(has(said, "Unknown colours")) << said;
  EXPECT_TRUE(has(said, path_.filename().string())) << said;
  EXPECT_EQ(numFiles(), 0u);
}

TEST_F(MovieWriterTest, FailuresWhileItReadsAndAtItsEnd) {
  {
    const FakeFfmpeg fake("head -c 10000 > /dev/null; echo No space left >&2; exit 1");
    EXPECT_TRUE(has(failure(), "No space left"));
  }
  {
    const FakeFfmpeg fake(
        "cat > /dev/null; printf half > /proc/self/fd/3; echo trailer >&2; exit 2");
    EXPECT_TRUE(has(failure(), "trailer"));
  }
  {
    const FakeFfmpeg fake("cat > /dev/null; kill -9 $$");
    EXPECT_TRUE(has(failure(), "signal 9"));
  }
  {
    const FakeFfmpeg fake("cat > /dev/null; exit 5");
    EXPECT_TRUE(has(failure(), "code 5"));
  }
  {
    const FakeFfmpeg fake("cat > /dev/null");
    EXPECT_TRUE(has(failure(), "wrote nothing"));
  }
  EXPECT_EQ(numFiles(), 0u);
}

TEST_F(MovieWriterTest, AFailureKeepsWhatWasThere) {
  testing::writeFile(path_, "precious");
  {
    const FakeFfmpeg fake("cat > /dev/null; printf half > /proc/self/fd/3; exit 1");
    EXPECT_TRUE(has(failure(Overwrite::kReplace), "code 1"));
  }
  const FakeFfmpeg fake;
  EXPECT_TRUE(has(failure(), "exists already"));
  EXPECT_FALSE(fake.wasCalled()) << "before the work, not after it";
  EXPECT_EQ(testing::readFile(path_), "precious");
  EXPECT_EQ(numFiles(), 1u);
  writeMovie(path_, movie({{0, 1}}), paint(), paper_, Overwrite::kReplace);
  EXPECT_EQ(testing::readFile(path_), "whole");
}

// Cancels once the program has been called; says whether it and what it started are gone, too.
TEST_F(MovieWriterTest, CancelledItLeavesNoFileAndNoProcess) {
  for (const char* body : {"sleep 1000 & echo $! > \"$here/child\"; wait",
                           "cat > /dev/null & echo $! > \"$here/child\"; wait; sleep 1000"}) {
    const FakeFfmpeg fake(body);
    const auto untilCalled = [&](double) { return !fs::exists(fake.file("child")); };
    EXPECT_THROW(
        writeMovie(path_, movie({{0, 5000}}), paint(), paper_, Overwrite::kRefuse, untilCalled),
        Cancelled);
    EXPECT_FALSE(fake.runs("pid")) << body;
    EXPECT_TRUE(fake.ends("child")) << body;
    EXPECT_EQ(numFiles(), 0u) << body;
  }
}

TEST_F(MovieWriterTest, ProgressGoesUpToTheEnd) {
  const FakeFfmpeg fake;
  std::vector<double> fractions;
  writeMovie(
      path_, movie({{0, 1}, {1, 1}, {2, 1}}), paint(), paper_, Overwrite::kRefuse, [&](double f) {
        fractions.push_back(f);
        return true;
      });
  ASSERT_GE(fractions.size(), 4u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1.0);
}

TEST_F(MovieWriterTest, WithoutFfmpegItSaysWhatToDo) {
  const FakeFfmpeg fake;
  qputenv("PALPATE_FFMPEG", "/no/such/ffmpeg");
  EXPECT_TRUE(has(failure(), "/no/such/ffmpeg"));
  EXPECT_EQ(numFiles(), 0u);
}

TEST_F(MovieWriterTest, PlansByTheStampsOfTheSpan) {
  const auto timeUs = [](std::size_t frame) { return static_cast<std::int64_t>(frame) * 100'000; };
  const Movie planned = plannedMovie({10, 13}, timeUs, {.picturesPerS = 20.0});
  EXPECT_EQ(planned.timing.shots, (std::vector<MovieFrame>{{0, 2}, {1, 2}, {2, 2}, {3, 2}}));
  EXPECT_EQ(planned.picturesPerS, 20.0);
  EXPECT_EQ(planned.frames, (FrameSpan{10, 13}));
  EXPECT_THROW(plannedMovie({10, 13}, timeUs, {}, [](double) { return false; }), Cancelled);
}

// Where ffmpeg is installed, the movie has the colours that were painted; where it isn't, that is
// said.
TEST_F(MovieWriterTest, TheColoursArriveAtTheEnd) {
  const auto ffmpeg = findFfmpeg();
  if (!ffmpeg) {
    EXPECT_TRUE(has(failure(), "ffmpeg"));
    return;
  }
  paper_.size = {64, 48};
  const std::vector<QColor> colors = {
      QColor(200, 40, 30), QColor(30, 160, 60), QColor(60, 90, 220)};
  const auto frame = [&](QPainter& painter, std::size_t i) {
    painter.fillRect(QRectF(0, 0, 64, 48), colors[i]);
  };
  writeMovie(path_, movie({{0, 3}, {1, 1}, {2, 4}}), frame, paper_);
  const fs::path raw = folder_ / "raw";
  ChildProgram reader(*ffmpeg,
                      {"-nostdin",
                       "-loglevel",
                       "error",
                       "-i",
                       "file:" + path_.string(),
                       "-f",
                       "rawvideo",
                       "-pix_fmt",
                       "rgb24",
                       raw.string()});
  ASSERT_EQ(reader.finish(), 0) << reader.said();
  const std::string pixels = testing::readFile(raw);
  constexpr std::size_t kPicture = 64 * 48 * 3;
  const std::vector<std::size_t> expected = {0, 0, 0, 1, 2, 2, 2, 2};
  ASSERT_EQ(pixels.size(), expected.size() * kPicture);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto at = [&](std::size_t byte) {
      return static_cast<int>(
          static_cast<unsigned char>(pixels[i * kPicture + kPicture / 2 + byte]));
    };
    const QColor& color = colors[expected[i]];
    EXPECT_NEAR(at(0), color.red(), 8) << i;
    EXPECT_NEAR(at(1), color.green(), 8) << i;
    EXPECT_NEAR(at(2), color.blue(), 8) << i;
  }
}

}  // namespace
}  // namespace palpate::gui::movie_writer_test

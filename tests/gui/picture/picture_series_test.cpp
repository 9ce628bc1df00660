#include "gui/picture/picture_series.h"

#include <QImage>
#include <QPainter>
#include <csignal>
#include <set>

#include <sys/resource.h>

#include <palpate/core/error.h>

#include "testing/testing.h"

namespace palpate::gui::picture_series_test {
namespace {

namespace fs = std::filesystem;

class PictureSeriesTest : public ::testing::Test {
 protected:
  FileSeries series(std::size_t first, std::size_t last) {
    return {.folder = folder_ / "new" / "pictures",
            .stem = "ball",
            .ending = ".png",
            .first = first,
            .last = last};
  }
  // Frame n is of red n.
  static void paint(QPainter& painter, std::size_t frame) {
    painter.fillRect(QRectF(0, 0, 40, 30), QColor(static_cast<int>(frame), 0, 0));
  }
  std::set<std::string> names() {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_ / "new" / "pictures"))
      all.insert(entry.path().filename().string());
    return all;
  }
  PicturePaper paper_{.size = {40, 30}, .unitsPerInch = 96.0, .dpi = 192.0};
  testing::TemporaryFolder folder_;
};

TEST_F(PictureSeriesTest, HasBothEndsAndEachFrameItsOwnPicture) {
  const SeriesReport report = writePictureSeries(series(98, 101), &paint, paper_);
  EXPECT_EQ(report.written, 4u);
  EXPECT_FALSE(report.cancelled);
  EXPECT_EQ(report.failure, "");
  EXPECT_EQ(names(),
            (std::set<std::string>{
                "ball_00098.png", "ball_00099.png", "ball_00100.png", "ball_00101.png"}));
  for (std::size_t frame = 98; frame <= 101; ++frame) {
    const QImage image(QString::fromStdString(series(98, 101).path(frame).string()));
    EXPECT_EQ(image.size(), QSize(80, 60));
    EXPECT_EQ(image.pixelColor(40, 30).red(), static_cast<int>(frame));
    EXPECT_EQ(image.dotsPerMeterX(), 7559);  // 192 / 0.0254
  }
}

TEST_F(PictureSeriesTest, CancelledKeepsWhatIsWholeAndSaysHowMany) {
  int asked = 0;
  const SeriesReport report = writePictureSeries(
      series(0, 9), &paint, paper_, Overwrite::kRefuse, [&](double) { return ++asked <= 3; });
  EXPECT_TRUE(report.cancelled);
  EXPECT_EQ(report.written, 3u);
  EXPECT_EQ(names().size(), 3u) << "and nothing else is left";
  for (const std::string& name : names())
    EXPECT_FALSE(
        QImage(QString::fromStdString((folder_ / "new" / "pictures" / name).string())).isNull());
}

TEST_F(PictureSeriesTest, CancelledAtOnceWritesNothing) {
  const SeriesReport report = writePictureSeries(
      series(0, 9), &paint, paper_, Overwrite::kRefuse, [](double) { return false; });
  EXPECT_EQ(report.written, 0u);
  EXPECT_TRUE(names().empty());
}

TEST_F(PictureSeriesTest, RefusesBeforeItWritesAnything) {
  fs::create_directories(folder_ / "new" / "pictures");
  testing::writeFile(series(0, 9).path(9), "precious");
  EXPECT_THROW(writePictureSeries(series(0, 9), &paint, paper_), FileError);
  EXPECT_EQ(names().size(), 1u);
  EXPECT_EQ(testing::readFile(series(0, 9).path(9)), "precious");
  EXPECT_EQ(writePictureSeries(series(0, 9), &paint, paper_, Overwrite::kReplace).written, 10u);
  EXPECT_NE(testing::readFile(series(0, 9).path(9)), "precious");
}

TEST_F(PictureSeriesTest, AFailureInBetweenIsReported) {
  // The place of the fourth picture is taken by a folder.
  const auto paintOver = [&](QPainter& painter, std::size_t frame) {
    paint(painter, frame);
    if (frame == 2) fs::create_directory(series(0, 9).path(3));
  };
  const SeriesReport report = writePictureSeries(series(0, 9), paintOver, paper_);
  EXPECT_EQ(report.written, 3u);
  EXPECT_NE(report.failure.find("ball_00003.png"), std::string::npos) << report.failure;
}

TEST_F(PictureSeriesTest, AFolderThatCantBeMadeIsSaid) {
  testing::writeFile(folder_ / "new", "");
  try {
    writePictureSeries(series(0, 9), &paint, paper_);
    FAIL() << "nothing was thrown";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("can't be created as a folder"), std::string::npos)
        << error.what();
  }
}

// The same error as of a full disk comes from a limit on the size of files.
TEST_F(PictureSeriesTest, ADiskThatTakesNoMoreIsSaid) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // an error, not the end of the program
  const auto paintUntil = [&](QPainter& painter, std::size_t frame) {
    paint(painter, frame);
    if (frame != 2) return;
    rlimit small = before;
    small.rlim_cur = 16;
    setrlimit(RLIMIT_FSIZE, &small);
  };
  const SeriesReport report = writePictureSeries(series(0, 9), paintUntil, paper_);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(report.written, 2u);
  EXPECT_NE(report.failure.find("ball_00002.png"), std::string::npos) << report.failure;
  EXPECT_EQ(names().size(), 2u) << "no half file";
}

}  // namespace
}  // namespace palpate::gui::picture_series_test

#include "gui/export/export_request.h"

#include "testing/testing.h"

namespace palpate::gui::export_request_test {
namespace {

class ExportRequestTest : public ::testing::Test {
 protected:
  QSettings settings() {
    return {QString::fromStdString((folder_ / "a.ini").string()), QSettings::IniFormat};
  }
  testing::TemporaryFolder folder_;
};

TEST_F(ExportRequestTest, IsRememberedButNotThatFilesMayBeReplaced) {
  ExportRequest request;
  request.view = "Timeline";
  request.form = ExportFormat::kPdf;
  request.preset = kOwnPreset;
  request.sizeMm = {100.5, 61.5};
  request.textPt = 6.5;
  request.dpi = 600;
  request.forPrint = false;
  request.titled = false;
  request.frames = ExportFrames::kAll;
  request.movieSpeed = 0.25;
  request.moviePicturesPerS = 60;
  request.movieHeightPx = 720;
  request.table = "what is seen";
  request.folder = QString::fromStdString(folder_.path().string());
  request.name = "figure 3";
  request.nameIsOwn = true;
  request.source = "/recordings/ball.dsa";
  request.replace = true;
  {
    QSettings to = settings();
    saveExportRequest(request, to);
  }
  request.replace = false;
  request.sizes = {{"Timeline", request.size()}};
  EXPECT_EQ(loadExportRequest(settings()), request);
}

// 85 mm wide for a journal: a low dock makes no flat curve, and each view has its own height.
TEST_F(ExportRequestTest, AChartIsHalfAsHighAsWideAndEachViewKeepsItsSize) {
  ExportedView chart, matrices;
  chart.name = "Chart";
  chart.minHeightShare = kChartHeight;
  chart.size = [] { return QSizeF(1350, 160); };
  matrices.name = "Matrices";
  matrices.size = [] { return QSizeF(800, 400); };
  EXPECT_EQ(sizeOfPreset(1, chart), QSizeF(85.0, 42.5));
  EXPECT_EQ(sizeOfPreset(3, chart), QSizeF(174.0, 87.0));
  EXPECT_EQ(chart.sizeOnPaperMm(60.0), QSizeF(60.0, 40.0)) << "at least 40 mm";
  EXPECT_EQ(sizeOfPreset(1, matrices), QSizeF(85.0, 42.5));
  EXPECT_EQ(sizeOfPreset(kOwnPreset, chart), std::nullopt);
  ExportRequest request;
  request.view = "Chart";
  request.preset = 1;
  request.sizeMm = {85.0, 60.0};  // a height that was typed
  request.textPt = 7.0;
  QSettings to = settings();
  saveExportRequest(request, to);
  request.view = "Matrices";
  request.preset = kOwnPreset;
  request.sizeMm = {200.0, 30.0};
  saveExportRequest(request, to);
  const ExportRequest last = loadExportRequest(to);
  EXPECT_EQ(sizeFor(chart, last), (ExportSize{1, {85.0, 60.0}, 7.0}));
  EXPECT_EQ(sizeFor(matrices, last).sizeMm, QSizeF(200.0, 30.0));
  ExportedView other = chart;
  other.name = "Other";
  EXPECT_EQ(sizeFor(other, last).sizeMm, QSizeF(200.0, 100.0)) << "not exported before";
  EXPECT_EQ(heightHintOf(last, matrices), "");
  EXPECT_EQ(heightHintOf(last, chart),
            "Below 40 mm the text of a chart may become smaller than typed.");
}

TEST_F(ExportRequestTest, NonsenseInTheSettingsIsReplacedByTheUsual) {
  testing::writeFile(folder_ / "a.ini",
                     "[export]\nform=GIF\nsize=poster\nwidth_mm=nan\nheight_mm=-3\ntext_pt=1e9\n"
                     "dpi=7\nmovie_speed=3\nmovie_pictures_per_s=nan\nmovie_height_px=-1\nframes="
                     "9\nfolder=relative/path\nname_is_own=true\n");
  const ExportRequest read = loadExportRequest(settings());
  ExportRequest usual;
  usual.folder = read.folder;
  EXPECT_EQ(read, usual);
  EXPECT_TRUE(read.folder.startsWith('/')) << read.folder.toStdString();
}

TEST_F(ExportRequestTest, PaperIsInHalfPoints) {
  ExportRequest request;
  request.preset = 1;
  request.sizeMm = {85.0, 60.0};
  request.textPt = 7.5;
  request.dpi = 600;
  const PicturePaper paper = paperOf(request, {900, 720});
  EXPECT_NEAR(paper.sizeMm().width(), 85.0, 1e-9);
  EXPECT_NEAR(paper.sizeMm().height(), 60.0, 1e-9);
  EXPECT_EQ(paper.pixels(), QSize(2008, 1417));  // 85 / 25.4 * 600, 60 / 25.4 * 600
  const PictureLook look = lookOf(request, {900, 720});
  EXPECT_EQ(look.textUnits, 15);
  EXPECT_NEAR(look.pixelRatio, 600.0 / 144.0, 1e-12);
  request.form = ExportFormat::kPdf;
  EXPECT_EQ(lookOf(request, {900, 720}).pixelRatio, 0.0);
}

TEST_F(ExportRequestTest, AsOnScreenHasTheScreensPixelsAtAnyResolution) {
  ExportRequest request;
  request.dpi = 150;
  const PicturePaper paper = paperOf(request, {960, 480});
  EXPECT_EQ(paper.size, QSizeF(960, 480));
  EXPECT_NEAR(paper.sizeMm().width(), 254.0, 1e-9);  // 10 inches of 96
  EXPECT_EQ(paper.pixels(), QSize(1500, 750));
  EXPECT_EQ(lookOf(request, {960, 480}).textUnits, 0);
}

TEST_F(ExportRequestTest, WhereItGoes) {
  ExportRequest request;
  request.folder = "/f";
  request.name = "a.b";
  request.form = ExportFormat::kSvg;
  EXPECT_EQ(pathOf(request), "/f/a.b.svg");
  request.form = ExportFormat::kPng;
  request.frames = ExportFrames::kAll;
  EXPECT_EQ(seriesOf(request, {3, 9}).path(9), "/f/a.b/a.b_00009.png");
  FramePictures pictures;
  pictures.numFrames = 10;
  EXPECT_EQ(spanOf(request, pictures), (FrameSpan{0, 9}));
  request.frames = ExportFrames::kSelected;
  EXPECT_EQ(spanOf(request, pictures), std::nullopt);
  pictures.selected = FrameSpan{4, 4};
  EXPECT_EQ(spanOf(request, pictures), (FrameSpan{4, 4}));
  pictures.numFrames = 0;
  EXPECT_EQ(spanOf(request, pictures), std::nullopt);
}

TEST_F(ExportRequestTest, AMovieIsSoHighWhateverThePaper) {
  ExportRequest request;
  request.form = ExportFormat::kMovie;
  request.movieHeightPx = 720;
  request.dpi = 600;
  EXPECT_EQ(paperOf(request, {900, 600}).pixels(), QSize(1080, 720));
  EXPECT_NEAR(lookOf(request, {900, 600}).pixelRatio, 1.2, 1e-12);
  request.preset = kOwnPreset;
  request.sizeMm = {160.0, 90.0};
  EXPECT_EQ(paperOf(request, {900, 600}).pixels(), QSize(1280, 720));
}

TEST_F(ExportRequestTest, AMovieIsOneFileOfTheSelectedFramesElseOfAll) {
  ExportRequest request;
  request.form = ExportFormat::kMovie;
  request.folder = "/f";
  request.name = "ball";
  FramePictures pictures;
  pictures.numFrames = 10;
  for (const ExportFrames frames : {ExportFrames::kShown, ExportFrames::kAll}) {
    request.frames = frames;
    EXPECT_EQ(pathOf(request), "/f/ball.mp4");
    EXPECT_EQ(spanOf(request, pictures), (FrameSpan{0, 9}));
  }
  pictures.selected = FrameSpan{4, 6};
  EXPECT_EQ(spanOf(request, pictures), (FrameSpan{0, 9})) << "all were asked for";
  request.frames = ExportFrames::kShown;
  EXPECT_EQ(spanOf(request, pictures), (FrameSpan{4, 6}));
  request.movieSpeed = 0.5;
  request.moviePicturesPerS = 25;
  EXPECT_EQ(movieOptionsOf(request).speed, 0.5);
  EXPECT_EQ(movieOptionsOf(request).picturesPerS, 25.0);
}

TEST_F(ExportRequestTest, BytesReadWell) {
  EXPECT_EQ(bytesText(8), "8 B");
  EXPECT_EQ(bytesText(1500), "1.5 kB");
  EXPECT_EQ(bytesText(142'300), "142 kB");
  EXPECT_EQ(bytesText(57.4e6), "57 MB");
}

TEST_F(ExportRequestTest, ADiskThatIsTooSmallIsSaid) {
  ExportRequest request;
  request.folder = QString::fromStdString(folder_.path().string());
  EXPECT_EQ(spaceProblemOf(request, 1.0), "");
  EXPECT_TRUE(spaceProblemOf(request, 1e18).contains("are free there"));
}

}  // namespace
}  // namespace palpate::gui::export_request_test

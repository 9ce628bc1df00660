#include "gui/picture/picture_export.h"

#include <QImageReader>
#include <QSvgRenderer>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include <palpate/core/error.h>

#include "gui/matrices/matrices_painter.h"
#include "gui/testing/sample_profiles.h"
#include "testing/testing.h"

namespace palpate::gui::picture_export_test {
namespace {

MatricesPictureOptions named() {
  MatricesPictureOptions options;
  options.title = "ball.dsa";
  options.caption = "frame 7 · 0.35 s";
  options.rangeMax = 100.0;
  return options;
}

TactileFrame touched() {
  TactileFrame frame = emptyFrame();
  frame.matrix(1)(7, 2) = 100.0F;
  return frame;
}

// A frame's heat maps as a file of options.size pixels at 96 per inch; PNG has twice as many.
void writeMatricesPicture(const std::filesystem::path& path,
                          const TactileFrame& frame,
                          const HandDescription& hand,
                          MatricesPictureOptions options,
                          Overwrite overwrite = Overwrite::kRefuse) {
  options.pixelRatio = imageFormatOf(path) == ImageFormat::kPng ? 2.0 : 0.0;
  const PicturePaper paper = {.size = options.size,
                              .unitsPerInch = 96.0,
                              .dpi = 2.0 * 96.0,
                              .background = colorsOf(options.theme).window,
                              .title = options.title,
                              .description = options.caption};
  const auto paint = [&](QPainter& painter) {
    paintMatricesPicture(painter, QRectF(QPointF(), options.size), frame, hand, options);
  };
  writePicture(path, paint, paper, overwrite);
}

TEST(PictureExport, TheEndingTellsTheForm) {
  EXPECT_EQ(imageFormatOf("a/b.png"), ImageFormat::kPng);
  EXPECT_EQ(imageFormatOf("b.SVG"), ImageFormat::kSvg);
  EXPECT_EQ(imageFormatOf("b.x.pdf"), ImageFormat::kPdf);
  EXPECT_EQ(imageFormatOf("b.gif"), std::nullopt);
  EXPECT_EQ(imageFormatOf("png"), std::nullopt);
}

TEST(PictureExport, PngHoldsThePictureAtTwiceItsSize) {
  const testing::TemporaryFolder folder;
  const auto path = folder / "a.png";
  writeMatricesPicture(path, touched(), sdh2(), named());
  const QImage image(QString::fromStdString(path.string()));
  EXPECT_EQ(image.size(), QSize(1800, 1440));
  MatricesPictureOptions options = named();
  options.pixelRatio = 2.0;
  const MatricesGeometry geometry(QRectF(QPointF(), options.size), sdh2(), options);
  const QPointF middle = 2.0 * geometry.taxelRect(1, 7, 2).center();
  EXPECT_EQ(image.pixel(middle.toPoint()), colorTable(ColorMapName::kInferno)[255]);
}

TEST(PictureExport, SvgKeepsTextAsTextAndCanBeDrawn) {
  const testing::TemporaryFolder folder;
  const auto path = folder / "a.svg";
  writeMatricesPicture(path, touched(), sdh2(), named());
  const std::string text = testing::readFile(path);
  for (const char* part : {"finger 0 distal", "ball.dsa", "frame 7", "counts"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  QSvgRenderer renderer(QString::fromStdString(path.string()));
  ASSERT_TRUE(renderer.isValid());
  EXPECT_EQ(renderer.viewBox(), QRect(0, 0, 900, 720));
  EXPECT_NE(text.find("width=\"238.125mm\""), std::string::npos) << "900 px at 96 per inch";
}

TEST(PictureExport, PdfHasOnePageOfThePicturesSize) {
  const testing::TemporaryFolder folder;
  const auto path = folder / "a.pdf";
  writeMatricesPicture(path, touched(), sdh2(), named());
  const std::string bytes = testing::readFile(path);
  EXPECT_EQ(bytes.substr(0, 5), "%PDF-");
  EXPECT_NE(bytes.find("/MediaBox [0 0 675"), std::string::npos);  // 900 px * 72/96
  EXPECT_NE(bytes.find("/Count 1"), std::string::npos);
}

TEST(PictureExport, RefusesToReplaceAndToGuess) {
  const testing::TemporaryFolder folder;
  const auto path = folder / "a.png";
  testing::writeFile(path, "precious");
  EXPECT_THROW(writeMatricesPicture(path, touched(), sdh2(), named()), FileError);
  EXPECT_EQ(testing::readFile(path), "precious");
  writeMatricesPicture(path, touched(), sdh2(), named(), Overwrite::kReplace);
  EXPECT_NE(testing::readFile(path), "precious");
  EXPECT_THROW(writeMatricesPicture(folder / "a.gif", touched(), sdh2(), named()), FileError);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.gif"));
  EXPECT_THROW(writeMatricesPicture(folder / "no" / "a.png", touched(), sdh2(), named()),
               FileError);
}

}  // namespace
}  // namespace palpate::gui::picture_export_test

#include "gui/chart/chart_picture.h"

#include <QImage>
#include <QPainter>

#include "gui/chart/chart_style.h"
#include "gui/chart/plot.h"
#include "gui/picture/picture_export.h"
#include "testing/testing.h"

namespace palpate::gui::chart_picture_test {
namespace {

// A line from (0, 0) to (10, 10), of which 4 to 6 is seen.
class ChartPictureTest : public ::testing::Test {
 protected:
  ChartPictureTest() {
    applyTheme(*qApp, Theme::kDark);
    plot_.resize(600, 300);
    arrangeChart(plot_);
    styleChart(plot_);
    plot_.xAxis->setLabel("time in s");
    plot_.yAxis->setLabel("mean in counts");
    plot_.addGraph();
    plot_.graph(0)->setPen(curvePen(1, false));
    for (int i = 0; i <= 10; ++i) plot_.graph(0)->addData(i, i);
    plot_.xAxis->setRange(4.0, 6.0);
    plot_.yAxis->setRange(4.5, 5.5);
    look_.size = {480.0, 280.0};
    look_.forPrint = true;
    look_.textUnits = 16;
  }
  std::string svg() {
    return pictureBytes(
               ImageFormat::kSvg,
               [this](QPainter& painter) { paintChart(painter, look_, plot_, options_); },
               {.size = look_.size, .unitsPerInch = 144.0},
               "a.svg")
        .toStdString();
  }
  QImage image() {
    return pictureImage([this](QPainter& painter) { paintChart(painter, look_, plot_, options_); },
                        {.size = look_.size, .unitsPerInch = 144.0, .dpi = 144.0});
  }
  static int numPixels(const QImage& image, const QColor& color) {
    int found = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) found += image.pixelColor(x, y) == color ? 1 : 0;
    return found;
  }

  QCustomPlot plot_;
  PictureLook look_;
  ChartPictureOptions options_;
};

TEST_F(ChartPictureTest, IsAVectorGraphicWithTextAndNoImage) {
  options_.title = "ball.dsa";
  options_.legend = {{"finger 0 distal", plot_.graph(0)->pen()}};
  const std::string text = svg();
  for (const char* part : {"time in s", "mean in counts", "ball.dsa", "finger 0 distal", ">4.5<"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  EXPECT_EQ(text.find("<image"), std::string::npos);
  EXPECT_NE(text.find("font-size=\"16\""), std::string::npos);
  EXPECT_NE(text.find("clip-path"), std::string::npos) << "the curve ends at the axes";
}

TEST_F(ChartPictureTest, PrintIsDarkOnWhiteWhateverTheTheme) {
  const std::string text = svg();
  const QColor onScreen = matrixColor(1, Theme::kDark);
  const QColor onPaper = matrixColor(1, Theme::kLight);
  EXPECT_EQ(text.find(onScreen.name().toStdString()), std::string::npos);
  EXPECT_NE(text.find(onPaper.name().toStdString()), std::string::npos);
  const QImage printed = image();
  EXPECT_EQ(printed.pixelColor(1, 1), QColor(Qt::white));
  EXPECT_GT(numPixels(printed, Qt::white), printed.width() * printed.height() / 2);
  look_.forPrint = false;
  EXPECT_EQ(image().pixelColor(1, 1), colorsOf(Theme::kDark).window);
}

// "counts" alone doesn't tell mean, max and sum apart.
TEST_F(ChartPictureTest, TheAxisOfALowChartHasItsWholeNameWhereThePictureHasRoom) {
  plot_.yAxis->setLabel("counts");
  plot_.yAxis->setProperty(kWholeNameProperty, "mean in counts");
  EXPECT_NE(svg().find("mean in counts"), std::string::npos);
  EXPECT_EQ(plot_.yAxis->label(), "counts") << "as before";
  look_.size.setHeight(120.0);
  EXPECT_EQ(svg().find("mean in counts"), std::string::npos);
}

TEST_F(ChartPictureTest, TheCurveEndsAtTheAxes) {
  plot_.graph(0)->setPen(QPen(QColor("#c17d00"), 5.0));
  const QImage printed = image();
  EXPECT_GT(numPixels(printed, QColor("#c17d00")), 200);
  // Left of the axis and below it there are numbers only, and nothing of the curve's colour.
  for (int y = 0; y < printed.height(); ++y)
    for (int x = 0; x < 40; ++x)
      ASSERT_NE(printed.pixelColor(x, y), QColor("#c17d00")) << x << ", " << y;
}

// Title, legend and numbers would leave no room for the axes: a curve that rises on the screen
// rises in the picture, too.
TEST_F(ChartPictureTest, AxesWithoutRoomAreEnlargedNeverMirrored) {
  plot_.graph(0)->setPen(QPen(QColor("#c17d00"), 1.0));
  options_.title = "ball.dsa";
  for (int i = 0; i < 4; ++i)
    options_.legend.push_back({QString("finger %1 proximal").arg(i), QPen(Qt::black)});
  for (const QSizeF& size : {QSizeF(480, 110), QSizeF(480, 40), QSizeF(90, 400), QSizeF(60, 30)}) {
    look_.size = size;
    QRectF axes;
    const QImage picture =
        pictureImage([&](QPainter& painter) { axes = paintChart(painter, look_, plot_, options_); },
                     {.size = look_.size, .unitsPerInch = 144.0, .dpi = 1440.0});
    EXPECT_GT(axes.height(), 0.0) << size.width() << " x " << size.height();
    EXPECT_GT(axes.width(), 0.0);
    EXPECT_TRUE(QRectF(QPointF(), size).contains(axes)) << size.width() << " x " << size.height();
    // From (4, 4), cut at 4.5, to 5.5: it rises to the right.
    const auto onCurve = [&](double share) {
      const int x = static_cast<int>((axes.left() + share * axes.width()) * 10.0);
      for (int y = 0; y < picture.height(); ++y)
        if (const QColor found = picture.pixelColor(x, y); found.red() - found.blue() > 90)
          return y / 10.0;
      return -1.0;
    };
    const double first = onCurve(0.35), last = onCurve(0.65);
    EXPECT_GT(first, 0.0);
    EXPECT_GT(last, 0.0);
    // (4.7, 4.7) and (5.3, 5.3) of 4.5 to 5.5 on the vertical axis: 0.6 of its height.
    EXPECT_NEAR(first - last, 0.6 * axes.height(), 0.1 * axes.height() + 0.2)
        << size.width() << " x " << size.height();
  }
}

TEST_F(ChartPictureTest, TheChartIsAsBefore) {
  auto* word = wordAt(plot_, 5.0, "gap", Qt::AlignLeft, colorsOf(Theme::kDark).warning);
  auto* shade = shadeSpan(plot_, 4.5, 5.0);
  plot_.replot();
  const QImage before = plot_.toPixmap().toImage();
  const QPen pen = plot_.graph(0)->pen();
  const QFont font = word->font();
  const QBrush brush = shade->brush();
  image();
  EXPECT_EQ(plot_.graph(0)->pen(), pen);
  EXPECT_EQ(word->font(), font);
  EXPECT_EQ(shade->brush(), brush);
  EXPECT_EQ(plot_.size(), QSize(600, 300));
  plot_.replot();
  EXPECT_EQ(plot_.toPixmap().toImage(), before);
}

TEST_F(ChartPictureTest, GraphsWithNamesMakeALegend) {
  EXPECT_EQ(svg().find("Graph 1"), std::string::npos);
  plot_.graph(0)->setName("thumb");
  EXPECT_NE(svg().find(">thumb<"), std::string::npos);
}

// In the colour of the points, which is darker on paper where it could not be seen, and in their
// form: no line.
TEST_F(ChartPictureTest, PointsStandInTheLegendAsTheyAreDrawn) {
  const QColor yellow("#e6e600");
  const QCPScatterStyle points(QCPScatterStyle::ssSquare, yellow, yellow, 6.0);
  plot_.graph(0)->setLineStyle(QCPGraph::lsNone);
  plot_.graph(0)->setScatterStyle(points);
  options_.legend = {{"pen", QPen(yellow), points}};
  const auto area = [this](const QColor& color, const QImage& of) {
    int below = 0, widest = 0;
    for (int y = 0; y < 60; ++y) {
      int row = 0;
      for (int x = 0; x < of.width(); ++x) row += of.pixelColor(x, y) == color ? 1 : 0;
      widest = std::max(widest, row);
    }
    for (int y = 60; y < of.height(); ++y)
      for (int x = 0; x < of.width(); ++x) below += of.pixelColor(x, y) == color ? 1 : 0;
    return std::pair(widest, below);
  };
  for (const bool forPrint : {false, true}) {
    look_.forPrint = forPrint;
    const auto [widest, below] = area(forPrint ? QColor(inkOf(yellow).rgb()) : yellow, image());
    EXPECT_GE(widest, 5) << forPrint;
    EXPECT_LE(widest, 8) << "a square of 6 px, no line";
    EXPECT_GE(below, 25) << "the point that is seen";
    if (forPrint) {
      EXPECT_EQ(area(yellow, image()), std::pair(0, 0));
    }
  }
  EXPECT_EQ(plot_.graph(0)->scatterStyle().pen().color(), yellow) << "the chart is as before";
}

TEST_F(ChartPictureTest, ALongLegendTakesMoreRows) {
  for (int i = 0; i < 7; ++i)
    options_.legend.push_back({QString("finger %1 proximal").arg(i), plot_.graph(0)->pen()});
  const std::string text = svg();
  for (int i = 0; i < 7; ++i)
    EXPECT_NE(text.find("finger " + std::to_string(i)), std::string::npos);
  // No name begins beyond the right edge.
  for (auto at = text.find("<text x=\""); at != std::string::npos;
       at = text.find("<text x=\"", at + 1))
    EXPECT_LT(std::stod(text.substr(at + 9)), look_.size.width());
}

TEST_F(ChartPictureTest, WithoutTitleLineThereIsMoreRoom) {
  options_.title = "ball.dsa";
  look_.titled = false;
  EXPECT_EQ(svg().find("ball.dsa"), std::string::npos);
}

TEST_F(ChartPictureTest, TheSpaceLeftOfTheAxisFitsTheSizeOfTheText) {
  plot_.replot();
  const int before = plot_.axisRect()->left();
  QFont large = plot_.font();
  large.setPointSizeF(1.8 * large.pointSizeF());
  plot_.setFont(large);
  plot_.replot();
  plot_.replot(QCustomPlot::rpImmediateRefresh);
  EXPECT_GE(plot_.axisRect()->left(), QFontMetrics(large).horizontalAdvance("00000"));
  EXPECT_GT(plot_.axisRect()->left(), before);
  EXPECT_EQ(plot_.axisRect()->minimumMargins().left(), timeAxisLeft(plot_));
}

TEST(InkOf, CanBeSeenOnWhite) {
  EXPECT_EQ(inkOf(matrixColor(4, Theme::kDark)), matrixColor(4, Theme::kLight));
  EXPECT_EQ(inkOf(matrixColor(4, Theme::kLight)), matrixColor(4, Theme::kLight));
  EXPECT_EQ(inkOf(colorsOf(Theme::kDark).window), QColor(Qt::white));
  EXPECT_EQ(inkOf(colorsOf(Theme::kDark).muted), colorsOf(Theme::kLight).text);
  // Relative luminance (WCAG 2) of #ffff00 is 0.93: 1.07:1 on white.
  const QColor yellow = inkOf("#ffff00");
  EXPECT_LT(yellow.lightnessF(), QColor("#ffff00").lightnessF());
  EXPECT_EQ(yellow.hue(), QColor("#ffff00").hue());
  EXPECT_EQ(inkOf("#aa0000"), QColor("#aa0000")) << "dark enough";
}

}  // namespace
}  // namespace palpate::gui::chart_picture_test

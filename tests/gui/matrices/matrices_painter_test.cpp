#include "gui/matrices/matrices_painter.h"

#include <QImage>
#include <QPainter>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_file.h"

#include "gui/testing/sample_profiles.h"
#include "testing/testing.h"

namespace palpate::gui::matrices_painter_test {
namespace {

MatricesPictureOptions options() {
  MatricesPictureOptions usual;
  usual.rangeMin = 0.0;
  usual.rangeMax = 255.0;  // a value is its own index into the colour table
  usual.pixelRatio = 1.0;
  usual.theme = Theme::kDark;
  return usual;
}

constexpr QSize kSize(700, 640);

QImage paint(const TactileFrame& frame,
             const MatricesPictureOptions& with,
             const HandDescription& hand = sdh2()) {
  QImage image(kSize, QImage::Format_RGB32);
  image.fill(Qt::magenta);  // what isn't painted is seen
  QPainter painter(&image);
  paintMatricesPicture(painter, QRectF(QPointF(), QSizeF(kSize)), frame, hand, with);
  return image;
}

MatricesGeometry geometry(const MatricesPictureOptions& with = options(),
                          const HandDescription& hand = sdh2(),
                          QSize size = kSize) {
  return MatricesGeometry(QRectF(QPointF(), QSizeF(size)), hand, with);
}

QColor at(const QImage& image, const QPointF& point) { return image.pixelColor(point.toPoint()); }

QColor inferno(std::size_t index) {
  return QColor::fromRgb(colorTable(ColorMapName::kInferno)[index]);
}

// Two matrices of a finger stand one below the other: "0" alone would name both.
TEST(MatricesPainter, ShortenedNamesStillTellMatricesApart) {
  const auto nameWithin = [](std::size_t matrix, qsizetype letters) {
    return matrixNameWithin(
        sdh2(), matrix, [letters](const QString& name) { return name.size() <= letters; });
  };
  EXPECT_EQ(nameWithin(0, 40), "finger 0 proximal");
  EXPECT_EQ(nameWithin(0, 10), "0 proximal");
  EXPECT_EQ(nameWithin(0, 7), "0 prox.");
  EXPECT_EQ(nameWithin(0, 6), "0 P");
  EXPECT_EQ(nameWithin(1, 6), "0 D");
  EXPECT_EQ(nameWithin(1, 2), "0D");
  for (const qsizetype letters : {2, 3, 6, 7, 8, 10, 40}) {
    QStringList names;
    for (std::size_t m = 0; m < sdh2().matrices.size(); ++m) names << nameWithin(m, letters);
    EXPECT_EQ(names.removeDuplicates(), 0) << letters;
  }
}

TEST(MatricesGeometry, LiesLikeTheFingers) {
  const MatricesGeometry g = geometry();
  for (std::size_t finger = 0; finger < 3; ++finger) {
    const QRectF proximal = g.matrixRect(2 * finger);
    const QRectF distal = g.matrixRect(2 * finger + 1);
    EXPECT_LT(distal.bottom(), proximal.top()) << "fingertips on top";
    EXPECT_EQ(distal.left(), proximal.left());
    if (finger > 0) {
      EXPECT_GT(distal.left(), g.matrixRect(2 * finger - 1).right());
    }
    // 13 and 14 rows, 6 columns of squares of one size.
    EXPECT_DOUBLE_EQ(distal.height() / distal.width(), 13.0 / 6.0);
    EXPECT_DOUBLE_EQ(proximal.height() / proximal.width(), 14.0 / 6.0);
    EXPECT_DOUBLE_EQ(g.taxelSide(2 * finger), g.taxelSide(1));
  }
  EXPECT_GT(g.colorBarRect().left(), g.matrixRect(5).right());
}

TEST(MatricesGeometry, TaxelsHaveTheShapeOfTheirPitch) {
  const HandDescription hand = parseHand(
      R"({"format": "palpate-hand", "version": 1, "name": "pad", "full_scale": 10, "matrices":
          [{"name": "a", "rows": 3, "columns": 4, "pitch_mm": [5, 10]}]})",
      "",
      "hand.json");
  const MatricesGeometry g = geometry(options(), hand);
  const QRectF taxel = g.taxelRect(0, 2, 1);
  EXPECT_DOUBLE_EQ(taxel.height(), 2.0 * taxel.width());
  EXPECT_EQ(g.taxelSize(0), taxel.size());
  EXPECT_EQ(g.taxelSide(0), taxel.width());
  EXPECT_DOUBLE_EQ(g.matrixRect(0).height() / g.matrixRect(0).width(), 1.5);
  EXPECT_EQ(g.placeAt(taxel.center()), (TaxelPlace{0, 2, 1}));
}

TEST(MatricesGeometry, FitsIntoEverySizeWithWholePixels) {
  for (const QSize size : {QSize(320, 240), QSize(500, 900), QSize(1040, 600), QSize(1900, 1100)}) {
    const MatricesGeometry g = geometry(options(), sdh2(), size);
    const QRectF area(0, 0, size.width(), size.height());
    for (std::size_t m = 0; m < 6; ++m) {
      EXPECT_TRUE(area.contains(g.matrixRect(m))) << size.width() << ' ' << m;
      EXPECT_EQ(g.taxelSide(m), std::floor(g.taxelSide(m)));
      EXPECT_EQ(g.matrixRect(m).left(), std::floor(g.matrixRect(m).left()));
    }
    EXPECT_TRUE(area.contains(g.colorBarRect()));
  }
}

// A hand of `count` equal matrices in a grid of so many columns.
HandDescription handOf(std::size_t count, int rows, int columns, int gridColumns) {
  HandDescription hand;
  hand.layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>(count, MatrixLayout::full(rows, columns, 2.0)));
  for (int m = 0; m < static_cast<int>(count); ++m) {
    MatrixDescription matrix;
    matrix.name = "matrix " + std::to_string(m);
    matrix.shortName = std::to_string(m);
    matrix.pictureColumn = m % gridColumns;
    matrix.pictureRow = m / gridColumns;
    hand.matrices.push_back(matrix);
  }
  return hand;
}

TEST(MatricesGeometry, AnyNumberAndSizeOfMatricesIsInsideAndApart) {
  for (const HandDescription& hand : {handOf(64, 16, 16, 8),
                                      handOf(64, 14, 6, 64),
                                      handOf(64, 6, 14, 1),
                                      handOf(1, 256, 256, 1),
                                      handOf(1, 256, 1, 1),
                                      handOf(1, 1, 256, 1),
                                      handOf(1, 1, 1, 1)})
    for (const QSize size : {QSize(1200, 900), QSize(460, 500), QSize(360, 240)}) {
      const MatricesGeometry g = geometry(options(), hand, size);
      ASSERT_EQ(g.numMatrices(), hand.matrices.size());
      const QRectF area{QPointF(), QSizeF(size)};
      for (std::size_t m = 0; m < g.numMatrices(); ++m) {
        EXPECT_TRUE(area.contains(g.matrixRect(m)))
            << m << " of " << g.numMatrices() << " in " << size.width();
        EXPECT_FALSE(g.matrixRect(m).intersects(g.colorBarRect())) << m;
        for (std::size_t other = 0; other < m; ++other)
          EXPECT_FALSE(g.matrixRect(m).intersects(g.matrixRect(other))) << m << ", " << other;
        const MatrixLayout& layout = hand.layout->matrix(m);
        const TaxelPlace last{m, layout.rows - 1, layout.columns - 1};
        EXPECT_EQ(g.placeAt(g.taxelRect(m, last.y, last.x).center()), last);
      }
      EXPECT_TRUE(area.contains(g.colorBarRect()));
    }
}

TEST(MatricesGeometry, FindsEveryTaxelAtItsMiddle) {
  const MatricesGeometry g = geometry();
  for (std::size_t m = 0; m < 6; ++m)
    for (int y = 0; y < sdh2().layout->matrix(m).rows; ++y)
      for (int x = 0; x < 6; ++x)
        EXPECT_EQ(g.placeAt(g.taxelRect(m, y, x).center()), (TaxelPlace{m, y, x}));
  EXPECT_EQ(g.placeAt({1, 1}), std::nullopt);
  EXPECT_EQ(g.placeAt(g.matrixRect(5).bottomRight()), std::nullopt);
}

TEST(MatricesPainter, AValueHasTheColourOfTheMapAtItsPlace) {
  TactileFrame frame = emptyFrame();
  frame.matrix(1)(7, 2) = 200.0F;
  frame.matrix(4)(13, 5) = 31.0F;
  frame.matrix(0)(0, 0) = 1000.0F;  // beyond the range: the highest colour
  const QImage image = paint(frame, options());
  const MatricesGeometry g = geometry();
  EXPECT_EQ(at(image, g.taxelRect(1, 7, 2).center()), inferno(200));
  EXPECT_EQ(at(image, g.taxelRect(4, 13, 5).center()), inferno(31));
  EXPECT_EQ(at(image, g.taxelRect(0, 0, 0).center()), inferno(255));
  EXPECT_EQ(at(image, g.taxelRect(1, 7, 3).center()), colorsOf(Theme::kDark).taxel);
  EXPECT_EQ(at(image, g.taxelRect(3, 7, 2).center()), colorsOf(Theme::kDark).taxel);
}

TEST(MatricesPainter, RowZeroIsOnTopAndColumnZeroOnTheLeft) {
  TactileFrame frame = emptyFrame();
  frame.matrix(2)(0, 0) = 180.0F;
  const QImage image = paint(frame, options());
  const QRectF rect = geometry().matrixRect(2);
  const double half = geometry().taxelSide(2) / 2;
  EXPECT_EQ(at(image, rect.topLeft() + QPointF(half, half)), inferno(180));
  EXPECT_EQ(at(image, rect.bottomLeft() + QPointF(half, -half)), colorsOf(Theme::kDark).taxel);
}

TEST(MatricesPainter, PlacesWithoutTaxelStayEmpty) {
  const QImage image = paint(emptyFrame(), options());
  // The corners of a fingertip don't exist (five rows, first and last column).
  for (const int x : {0, 5})
    for (int y = 0; y < 5; ++y)
      EXPECT_EQ(at(image, geometry().taxelRect(1, y, x).center()), colorsOf(Theme::kDark).window);
  EXPECT_EQ(at(image, geometry().taxelRect(1, 5, 0).center()), colorsOf(Theme::kDark).taxel);
}

TEST(MatricesPainter, MaskedTaxelsAreCrossedOutWhateverTheyHold) {
  std::vector<MatrixLayout> matrices = sdh2().layout->matrices();
  matrices[3].dynamicMask[8 * 6 + 3] = 0;
  const HandDescription hand = describeHand(SensorLayout(matrices), 0, 0);
  TactileFrame frame(hand.layout);
  frame.matrix(3)(8, 3) = 250.0F;
  const QImage image = paint(frame, options(), hand);
  const QRectF place = geometry(options(), hand).taxelRect(3, 8, 3);
  int crossed = 0;
  for (int y = 1; y < place.height() - 2; ++y)
    for (int x = 1; x < place.width() - 2; ++x) {
      const QColor color = at(image, place.topLeft() + QPointF(x, y));
      if (color == colorsOf(Theme::kDark).maskedLine) ++crossed;
      EXPECT_NE(color, inferno(250));
      EXPECT_NE(color, colorsOf(Theme::kDark).taxel);
    }
  EXPECT_GT(crossed, 5);
}

// Taxels at rest are dark in both: weak touches are never the darkest places.
TEST(MatricesPainter, ThemesDiffer) {
  MatricesPictureOptions light = options();
  light.theme = Theme::kLight;
  const QImage image = paint(emptyFrame(), light);
  EXPECT_EQ(image.pixelColor(2, 2), QColor(Qt::white));
  EXPECT_EQ(at(image, geometry().taxelRect(0, 3, 3).center()), colorsOf(Theme::kDark).taxel);
}

TEST(MatricesPainter, SaturatedTaxelsAreFramed) {
  TactileFrame frame = emptyFrame();
  frame.matrix(1)(7, 2) = 3500.0F;  // the SDH-2 saturates here
  frame.matrix(1)(7, 4) = 3499.0F;
  MatricesPictureOptions full = options();
  full.rangeMax = 4095.0;
  const QImage image = paint(frame, full);
  const MatricesGeometry g = geometry(full);
  const auto corner = [&](int x) { return at(image, g.taxelRect(1, 7, x).topLeft()); };
  EXPECT_EQ(corner(2), QColor(Qt::white));
  EXPECT_NE(corner(4), QColor(Qt::white));
}

TEST(MatricesPainter, ValuesArePrintedInAContrastingColour) {
  TactileFrame frame = emptyFrame();
  frame.matrix(1)(7, 2) = 250.0F;  // light: black text
  frame.matrix(1)(9, 2) = 20.0F;   // dark: white text
  MatricesPictureOptions with = options();
  with.values = true;
  const QImage image = paint(frame, with);
  const auto darkest = [&](int y) {
    int lowest = 255;
    int highest = 0;
    const QRect place = geometry(with).taxelRect(1, y, 2).toRect().adjusted(1, 1, -2, -2);
    for (int py = place.top(); py <= place.bottom(); ++py)
      for (int px = place.left(); px <= place.right(); ++px) {
        lowest = std::min(lowest, qGray(image.pixel(px, py)));
        highest = std::max(highest, qGray(image.pixel(px, py)));
      }
    return std::pair(lowest, highest);
  };
  EXPECT_LT(darkest(7).first, 110) << "black on a light taxel";
  EXPECT_GT(darkest(9).second, 140) << "white on a dark taxel";
  const QImage without = paint(frame, options());
  EXPECT_EQ(at(without, geometry().taxelRect(1, 7, 2).center()), inferno(250));
}

TEST(MatricesPainter, SmoothIsExactWhereNeighboursAgree) {
  TactileFrame frame = emptyFrame();
  frame.matrix(0).setConstant(120.0F);
  MatricesPictureOptions smooth = options();
  smooth.interpolated = true;
  const QImage image = paint(frame, smooth);
  for (const int y : {0, 6, 13})
    for (const int x : {0, 3, 5})
      EXPECT_EQ(at(image, geometry(smooth).taxelRect(0, y, x).center()), inferno(120));
}

TEST(MatricesPainter, SmoothStaysInsideTheTaxelsThatExist) {
  TactileFrame frame = emptyFrame();
  frame.matrix(1).setConstant(200.0F);
  for (int y = 0; y < 5; ++y) frame.matrix(1)(y, 0) = frame.matrix(1)(y, 5) = 0.0F;
  MatricesPictureOptions smooth = options();
  smooth.interpolated = true;
  const QImage image = paint(frame, smooth);
  EXPECT_EQ(at(image, geometry(smooth).taxelRect(1, 2, 0).center()), colorsOf(Theme::kDark).window);
  // Beside the missing corner the value isn't pulled down by it.
  EXPECT_EQ(at(image, geometry(smooth).taxelRect(1, 2, 1).center()), inferno(200));
}

TEST(MatricesPainter, WithoutARangeTheFrameSetsIt) {
  TactileFrame frame = emptyFrame();
  frame.matrix(1)(7, 2) = 800.0F;
  frame.matrix(1)(7, 3) = 400.0F;
  MatricesPictureOptions automatic = options();
  automatic.rangeMax = 0.0;
  EXPECT_EQ(rangeOf(automatic, frame), (ValueRange{0.0, 800.0}));
  const QImage image = paint(frame, automatic);
  EXPECT_EQ(at(image, geometry(automatic).taxelRect(1, 7, 2).center()), inferno(255));
  EXPECT_EQ(at(image, geometry(automatic).taxelRect(1, 7, 3).center()), inferno(128));
  EXPECT_EQ(rangeOf(automatic, emptyFrame()), (ValueRange{0.0, 1.0}));
}

TEST(MatricesPainter, TheColourBarRunsFromLowBelowToHighAbove) {
  const QImage image = paint(emptyFrame(), options());
  const QRectF bar = geometry().colorBarRect();
  EXPECT_EQ(at(image, bar.topLeft() + QPointF(5, 2)), inferno(254));
  EXPECT_LT(qGray(at(image, bar.bottomLeft() + QPointF(5, -3)).rgb()), 8);
  const auto share = [&](double fromBottom) {
    return at(image, QPointF(bar.left() + 5, bar.bottom() - fromBottom * bar.height()));
  };
  EXPECT_NEAR(share(0.5).red(), inferno(128).red(), 4);
}

// analyst m23: a taxel that isn't touched doesn't have the colour of the smallest value.
TEST(MatricesPainter, TheColourBarShowsHowAnUntouchedTaxelLooks) {
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    MatricesPictureOptions look = options();
    look.theme = theme;
    const QImage image = paint(emptyFrame(), look);
    const QRectF bar = geometry(look).colorBarRect();
    EXPECT_EQ(at(image, bar.bottomLeft() + QPointF(5, 6)),
              at(image, geometry(look).taxelRect(1, 7, 2).center()));
  }
}

// In a low view the matrices have all of the room: names would lie over them.
TEST(MatricesPainter, NamesThatHaveNoRoomAreNotDrawn) {
  HandDescription named = sdh2(), nameless = sdh2();
  for (MatrixDescription& matrix : nameless.matrices) matrix.name = matrix.shortName = "";
  const TactileFrame frame(named.layout);
  const auto painted = [&](const HandDescription& hand, int height) {
    QImage image(300, height, QImage::Format_RGB32);
    QPainter painter(&image);
    paintMatricesPicture(painter, QRectF(0, 0, 300, height), frame, hand, options());
    return image;
  };
  ASSERT_EQ(geometry(options(), named, {300, 60}).nameRect(0).height(), 0.0);
  EXPECT_EQ(painted(named, 60), painted(nameless, 60));
  EXPECT_NE(painted(named, 400), painted(nameless, 400));
}

TEST(MatricesPainter, DrawsAnySensor) {
  for (const auto& [rows, columns] : {std::pair(1, 1), {4, 4}, {256, 256}, {2, 200}}) {
    const HandDescription hand =
        describeHand(SensorLayout({MatrixLayout::full(rows, columns, 2.0)}), 0, 0);
    TactileFrame frame(hand.layout);
    frame.matrix(0)(rows - 1, columns - 1) = 255.0F;
    const QImage image = paint(frame, options(), hand);
    const MatricesGeometry g = geometry(options(), hand);
    EXPECT_TRUE(QRectF(QPointF(), QSizeF(kSize)).contains(g.matrixRect(0)));
    const QPointF middle = g.taxelRect(0, rows - 1, columns - 1).center();
    EXPECT_NEAR(at(image, QPointF(std::floor(middle.x()), std::floor(middle.y()))).red(),
                inferno(255).red(),
                8)
        << rows;
  }
}

TEST(MatricesPainter, RefusesAFrameOfAnotherHand) {
  const HandDescription pad = describeHand(SensorLayout({MatrixLayout::full(3, 3, 1.0)}), 0, 0);
  EXPECT_THROW(paint(TactileFrame(pad.layout), options()), std::invalid_argument);
  EXPECT_THROW(paint(TactileFrame(), options()), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::gui::matrices_painter_test

// Heat maps of readings with a sign and three components.
#include <QImage>
#include <QPainter>

#include <gtest/gtest.h>

#include "palpate/model/touch.h"

#include "gui/appearance/difference_map.h"
#include "gui/matrices/drawn_taxels.h"
#include "gui/matrices/matrices_painter.h"
#include "gui/matrices/taxel_text.h"

namespace palpate::gui::readings_painter_test {
namespace {

constexpr QSize kSize(600, 300);

// Two rows of three taxels.
HandDescription padWith(const TouchRule& rule) {
  MatrixLayout matrix = MatrixLayout::full(2, 3, 2.0);
  matrix.touch = rule;
  return describeHand(SensorLayout({matrix}), 0, 0);
}
const HandDescription& threeAxes() {
  static const HandDescription hand =
      padWith({.components = 3, .isSigned = true, .threshold = 5.0F});
  return hand;
}

TactileFrame frameOf(const HandDescription& hand, std::vector<float> readings) {
  TactileFrame frame(hand.layout);
  frame.readings = std::move(readings);
  decideTouch(frame, nullptr);
  return frame;
}
// Pressed (and sheared by 30, 40), pulled, at rest; the second row is at rest.
TactileFrame pressedAndPulled() {
  return frameOf(threeAxes(), {30, 40, 120, 0, 0, -120, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0});
}

MatricesPictureOptions options() {
  MatricesPictureOptions usual;
  usual.pixelRatio = 1.0;
  usual.theme = Theme::kDark;
  usual.arrows = 0.0;
  return usual;
}

QImage paint(const TactileFrame& frame,
             const MatricesPictureOptions& with,
             const HandDescription& hand = threeAxes()) {
  QImage image(kSize, QImage::Format_RGB32);
  QPainter painter(&image);
  paintMatricesPicture(painter, QRectF(QPointF(), QSizeF(kSize)), frame, hand, with);
  return image;
}

// Beside the centre, from which an arrow begins.
QColor colorOf(const QImage& image, int y, int x) {
  const MatricesGeometry geometry(QRectF(QPointF(), QSizeF(kSize)), threeAxes(), options());
  return image.pixelColor((geometry.taxelRect(0, y, x).topLeft() + QPointF(3, 3)).toPoint());
}

TEST(DrawnTaxels, AreTheNormalComponentOrTheMagnitude) {
  const TactileFrame frame = pressedAndPulled();
  EXPECT_TRUE(hasShear(*threeAxes().layout));
  EXPECT_TRUE(hasSign(*threeAxes().layout));
  EXPECT_TRUE(isDrawnSigned(frame, TaxelView::kNormal));
  EXPECT_FALSE(isDrawnSigned(frame, TaxelView::kMagnitude));
  const MatrixValues normal = drawnValues(frame, 0, TaxelView::kNormal);
  EXPECT_EQ(normal(0, 0), 120.0F);
  EXPECT_EQ(normal(0, 1), -120.0F);
  // 30, 40, 120: 130.
  EXPECT_FLOAT_EQ(drawnValues(frame, 0, TaxelView::kMagnitude)(0, 0), 130.0F);
  EXPECT_EQ(drawnValues(frame, 0, TaxelView::kMagnitude)(0, 1), 120.0F);
  EXPECT_EQ(largestDrawn(frame, TaxelView::kNormal), 120.0);
  EXPECT_DOUBLE_EQ(largestDrawn(frame, TaxelView::kMagnitude), 130.0);
  EXPECT_EQ(shearAt(frame, {0, 0, 0}), QPointF(30, 40));
  EXPECT_EQ(shearAt(frame, {0, 0, 2}), QPointF()) << "not touched";
}

TEST(DrawnTaxels, WithoutReadingsAreTheValues) {
  const HandDescription plain = padWith({});
  TactileFrame frame(plain.layout);
  frame.matrix(0)(1, 2) = 7.0F;
  EXPECT_FALSE(hasShear(*plain.layout));
  EXPECT_FALSE(hasSign(*plain.layout));
  EXPECT_FALSE(isDrawnSigned(frame, TaxelView::kNormal));
  EXPECT_EQ(drawnValues(frame, 0, TaxelView::kMagnitude)(1, 2), 7.0F);
  EXPECT_EQ(largestDrawn(frame, TaxelView::kMagnitude), 0.0);
  TactileFrame filtered = pressedAndPulled();
  filtered.readings.clear();
  EXPECT_FALSE(isDrawnSigned(filtered, TaxelView::kNormal));
}

TEST(ReadingsPainter, SignsHaveTheEndsOfADivergingMap) {
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    MatricesPictureOptions with = options();
    with.theme = theme;
    const QImage image = paint(pressedAndPulled(), with);
    const ColorTable& table = differenceTable(theme);
    EXPECT_EQ(colorOf(image, 0, 0), QColor::fromRgb(table.back()));
    EXPECT_EQ(colorOf(image, 0, 1), QColor::fromRgb(table.front()));
    EXPECT_EQ(colorOf(image, 1, 1), colorsOf(theme).taxel) << "zero is neutral";
  }
}

TEST(ReadingsPainter, TheMagnitudeHasASequentialMap) {
  MatricesPictureOptions with = options();
  with.taxels = TaxelView::kMagnitude;
  const QImage image = paint(pressedAndPulled(), with);
  const ColorTable& table = colorTable(with.map);
  EXPECT_EQ(colorOf(image, 0, 0), QColor::fromRgb(table.back()));
  EXPECT_EQ(colorOf(image, 0, 1),
            QColor::fromRgb(table[static_cast<std::size_t>(colorIndex(120.0, 0.0, 130.0))]));
}

// The pressed taxel reads 120 into the surface; its magnitude is 130.
TEST(ReadingsPainter, TheNormalComponentSaturatesInEveryView) {
  const auto isFramed = [](float saturation, TaxelView view) {
    HandDescription hand = threeAxes();
    hand.saturationCounts = saturation;
    MatricesPictureOptions with = options();
    with.taxels = view;
    with.rangeMax = 500.0;  // no colour is white
    const MatricesGeometry geometry(QRectF(QPointF(), QSizeF(kSize)), hand, with);
    const QImage image = paint(pressedAndPulled(), with, hand);
    return image.pixelColor(geometry.taxelRect(0, 0, 0).topLeft().toPoint()) == QColor(Qt::white);
  };
  for (const TaxelView view : kAllTaxelViews) {
    EXPECT_TRUE(isFramed(120.0F, view));
    EXPECT_FALSE(isFramed(125.0F, view));
  }
}

TEST(ReadingsPainter, RangesOfSignedValuesLieAroundZero) {
  MatricesPictureOptions with = options();
  with.isSigned = true;
  EXPECT_EQ(rangeOf(with, pressedAndPulled()), (ValueRange{-120.0, 120.0}));
  with.rangeMin = 0.0;
  with.rangeMax = 300.0;
  EXPECT_EQ(rangeOf(with, pressedAndPulled()), (ValueRange{-300.0, 300.0}));
  with.isSigned = false;
  EXPECT_EQ(rangeOf(with, pressedAndPulled()), (ValueRange{0.0, 300.0}));
}

TEST(ReadingsPainter, ArrowsPointAlongTheSurfaceAndCanBeOff) {
  const QImage without = paint(pressedAndPulled(), options());
  MatricesPictureOptions with = options();
  with.arrows = 3.0;
  const QImage image = paint(pressedAndPulled(), with);
  EXPECT_NE(image, without);
  // x 30 to the next column, y 40 to the next row: 3 * (30, 40) / 120 sides of a taxel.
  const MatricesGeometry geometry(QRectF(QPointF(), QSizeF(kSize)), threeAxes(), options());
  const QPointF centre = geometry.taxelRect(0, 0, 0).center() - QPointF(0.5, 0.5);
  const QPointF way = geometry.taxelSide(0) * QPointF(0.75, 1.0);
  EXPECT_GT(image.pixelColor((centre + 0.5 * way).toPoint()).lightness(), 200);
  EXPECT_EQ(image.pixelColor((centre - 0.3 * way).toPoint()),
            without.pixelColor((centre - 0.3 * way).toPoint()));
  EXPECT_DOUBLE_EQ(arrowScale({-120.0, 120.0}, 3.0), 0.025);
  EXPECT_EQ(arrowScale({-1.0, 0.0}, 3.0), 0.0);
  // Alone, from the same frame.
  QImage alone(kSize, QImage::Format_RGB32);
  alone.fill(Qt::black);
  QPainter painter(&alone);
  paintShear(painter, geometry, 0, pressedAndPulled(), {-120.0, 120.0}, with);
  EXPECT_GT(alone.pixelColor((centre + 0.5 * way).toPoint()).lightness(), 200);
}

TEST(ReadingsPainter, OneComponentHasNoArrows) {
  const HandDescription pad = padWith({.isSigned = true, .threshold = 5.0F});
  const TactileFrame frame = frameOf(pad, {100, -100, 0, 0, 0, 0});
  MatricesPictureOptions with = options();
  const QImage without = paint(frame, with, pad);
  with.arrows = 10.0;
  EXPECT_EQ(paint(frame, with, pad), without);
  EXPECT_NE(colorOf(without, 0, 0), colorOf(without, 0, 1));
}

TEST(TaxelText, OfReadingsHasAllComponentsWithTheirSigns) {
  const auto text = [](const HandDescription& hand, const TactileFrame& frame, int x) {
    return taxelText(hand, {0, 0, x}, frame).section(" · ", 2);
  };
  EXPECT_EQ(text(threeAxes(),
                 frameOf(threeAxes(), {3, -2, 60, 0, 0, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}),
                 0),
            "x 3, y -2, z 60 counts");
  EXPECT_EQ(text(threeAxes(), pressedAndPulled(), 2), "x 0, y 0, z 2 counts, at rest");
  const HandDescription pad = padWith({.isSigned = true, .threshold = 5.0F});
  EXPECT_EQ(text(pad, frameOf(pad, {100, -100, 0, 0, 0, 0}), 1), "-100 counts");
}

}  // namespace
}  // namespace palpate::gui::readings_painter_test

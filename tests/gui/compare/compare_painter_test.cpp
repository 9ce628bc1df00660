#include "gui/compare/compare_painter.h"

#include <QImage>
#include <QPainter>
#include <cmath>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include <palpate/signals/frame_difference.h>

#include "gui/appearance/difference_map.h"
#include "gui/testing/sample_profiles.h"

namespace palpate::gui::compare_painter_test {
namespace {

// CIE lightness of an opaque colour, 0..100.
double lightness(QRgb rgb) {
  const auto linear = [](int byte) {
    const double channel = byte / 255.0;
    return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
  };
  const double y =
      0.2126 * linear(qRed(rgb)) + 0.7152 * linear(qGreen(rgb)) + 0.0722 * linear(qBlue(rgb));
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

TEST(DifferenceMap, ZeroIsTheColourOfATaxelAtRest) {
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    const ColorTable& table = differenceTable(theme);
    const QRgb rest = colorsOf(theme).taxel.rgb();
    EXPECT_EQ(table[127], rest);
    EXPECT_EQ(table[128], rest);
    EXPECT_EQ(table[static_cast<std::size_t>(colorIndex(0.0, -40.0, 40.0))], rest);
  }
}

TEST(DifferenceMap, GoesAwayFromTheMiddleEquallyOnBothSides) {
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    const ColorTable& table = differenceTable(theme);
    const double direction = theme == Theme::kDark ? 1.0 : -1.0;
    const double middle = lightness(table[128]);
    for (std::size_t i = 8; i < 128; i += 8) {
      const double ofA = direction * (lightness(table[128 + i]) - middle);
      const double ofB = direction * (lightness(table[127 - i]) - middle);
      EXPECT_GT(ofA, direction * (lightness(table[120 + i]) - middle)) << i;
      EXPECT_GT(ofB, direction * (lightness(table[135 - i]) - middle)) << i;
      EXPECT_NEAR(ofA, ofB, 0.12 * ofA + 2.0) << i;
    }
  }
}

// Blue against orange: what is left of the red-green channel to somebody who lacks it differs in
// blue.
TEST(DifferenceMap, SidesAreToldApartWithoutRedAndGreen) {
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    const ColorTable& table = differenceTable(theme);
    for (const std::size_t i : {40u, 80u, 127u}) {
      const QRgb a = table[128 + i], b = table[127 - i];
      EXPECT_GT(qBlue(b) - qRed(b), 20) << i;
      EXPECT_GT(qRed(a) - qBlue(a), 20) << i;
    }
    EXPECT_EQ(sideColor(CompareSide::kA, theme).rgb(), table[255]);
    EXPECT_EQ(sideColor(CompareSide::kB, theme).rgb(), table[0]);
  }
}

TEST(DifferenceMap, NumbersHaveTheirSign) {
  EXPECT_EQ(signedText(12.4, 0), "+12");
  EXPECT_EQ(signedText(-7.25, 1), "−7.2");
  EXPECT_EQ(signedText(0.0, 0), "0");
  EXPECT_EQ(signedText(-0.04, 1), "0.0");
}

class ComparePainterTest : public ::testing::Test {
 protected:
  ComparePainterTest() {
    frames_[0].frame = emptyFrame();
    frames_[1].frame = emptyFrame();
    options_.look.theme = Theme::kDark;
    options_.look.pixelRatio = 1.0;
    options_.look.rangeMax = 255.0;
    options_.look.font.setPixelSize(12);
    options_.largestDifference = 255.0 / 2.0;
  }
  void set(std::size_t matrix, int y, int x, float a, float b) {
    frames_[0].frame.matrix(matrix)(y, x) = a;
    frames_[1].frame.matrix(matrix)(y, x) = b;
  }
  QImage painted() {
    const FrameComparison comparison(hands_.a.layout, hands_.b.layout);
    hands_.difference = hands_.a;
    hands_.difference.layout = comparison.layout();
    frames_[2].frame = comparison.difference(frames_[0].frame, frames_[1].frame);
    QImage image(1200, 420, QImage::Format_RGB32);
    image.fill(Qt::magenta);
    QPainter painter(&image);
    paintComparison(painter, image.rect(), hands_, frames_, options_);
    geometry_ = CompareGeometry(image.rect(), hands_, options_);
    return image;
  }
  // Beside the middle, where a value's digits may stand.
  QColor color(const QImage& image, CompareGroup group, std::size_t matrix, int y, int x) {
    return image.pixelColor(
        (geometry_.group(group).taxelRect(matrix, y, x).topLeft() + QPointF(1, 1)).toPoint());
  }

  ComparedHands hands_{sdh2(), sdh2(), sdh2()};
  ComparedFrames frames_;
  ComparePictureOptions options_;
  CompareGeometry geometry_;
};

TEST_F(ComparePainterTest, EachGroupShowsItsValues) {
  set(1, 7, 2, 200.0F, 100.0F);
  set(1, 8, 2, 10.0F, 110.0F);
  set(1, 9, 2, 90.0F, 90.0F);
  const QImage image = painted();
  const ColorTable& inferno = colorTable(ColorMapName::kInferno);
  EXPECT_EQ(color(image, CompareGroup::kA, 1, 7, 2).rgb(), inferno[200]);
  EXPECT_EQ(color(image, CompareGroup::kB, 1, 7, 2).rgb(), inferno[100]);
  const ColorTable& table = differenceTable(Theme::kDark);
  const auto index = [](double difference) {
    return static_cast<std::size_t>(std::lround((difference + 127.5) / 255.0 * 255.0));
  };
  EXPECT_EQ(color(image, CompareGroup::kDifference, 1, 7, 2).rgb(), table[index(100.0)]);
  EXPECT_EQ(color(image, CompareGroup::kDifference, 1, 8, 2).rgb(), table[index(-100.0)]);
  EXPECT_EQ(color(image, CompareGroup::kDifference, 1, 9, 2), colorsOf(Theme::kDark).taxel);
  // The sign is seen: orange where A is larger, blue where B is.
  const QColor larger = color(image, CompareGroup::kDifference, 1, 7, 2);
  const QColor smaller = color(image, CompareGroup::kDifference, 1, 8, 2);
  EXPECT_GT(larger.red(), larger.blue());
  EXPECT_GT(smaller.blue(), smaller.red());
}

TEST_F(ComparePainterTest, AllGroupsHaveTheSameScale) {
  painted();
  const double side = geometry_.group(CompareGroup::kA).taxelSide(0);
  EXPECT_GT(side, 6.0);
  EXPECT_EQ(geometry_.group(CompareGroup::kB).taxelSide(0), side);
  EXPECT_EQ(geometry_.group(CompareGroup::kDifference).taxelSide(0), side);
  EXPECT_EQ(geometry_.group(CompareGroup::kA).matrixRect(3).top(),
            geometry_.group(CompareGroup::kDifference).matrixRect(3).top());
}

TEST_F(ComparePainterTest, SmoothKeepsSigns) {
  options_.look.interpolated = true;
  for (int y = 4; y < 8; ++y)
    for (int x = 1; x < 5; ++x) {
      set(1, y, x, 120.0F, 20.0F);
      set(3, y, x, 20.0F, 120.0F);
    }
  const QImage image = painted();
  const QColor larger = color(image, CompareGroup::kDifference, 1, 6, 3);
  const QColor smaller = color(image, CompareGroup::kDifference, 3, 6, 3);
  EXPECT_GT(larger.red(), larger.blue() + 40);
  EXPECT_GT(smaller.blue(), smaller.red() + 40);
  // Far from both: at rest.
  EXPECT_EQ(color(image, CompareGroup::kDifference, 5, 6, 3), colorsOf(Theme::kDark).taxel);
}

TEST_F(ComparePainterTest, WhatIsNotComparedIsCrossedOut) {
  std::vector<MatrixLayout> matrices = sdh2().layout->matrices();
  matrices[1] = MatrixLayout::full(8, 8, 3.4);
  const SensorLayout other(matrices);
  hands_.b = describeHand(other, 0, 0);
  frames_[1].frame = TactileFrame(hands_.b.layout);
  set(1, 7, 2, 200.0F, 100.0F);
  const QImage image = painted();
  EXPECT_EQ(color(image, CompareGroup::kDifference, 1, 7, 2), colorsOf(Theme::kDark).window);
  EXPECT_EQ(color(image, CompareGroup::kDifference, 0, 7, 2), colorsOf(Theme::kDark).taxel);
}

TEST_F(ComparePainterTest, ANoticeStandsWhereThereIsNoFrame) {
  set(1, 7, 2, 200.0F, 100.0F);
  const QImage with = painted();
  frames_[1].notice = "ended at 12.31 s";
  frames_[1].frame = TactileFrame();
  const auto below = frames_[2].frame;
  QImage without(1200, 420, QImage::Format_RGB32);
  QPainter painter(&without);
  frames_[2].frame = TactileFrame();
  paintComparison(painter, without.rect(), hands_, frames_, options_);
  painter.end();
  EXPECT_EQ(color(without, CompareGroup::kA, 1, 7, 2), color(with, CompareGroup::kA, 1, 7, 2));
  EXPECT_NE(color(with, CompareGroup::kB, 1, 7, 2), colorsOf(Theme::kDark).taxel);
  const QRectF group = geometry_.group(CompareGroup::kB).matrixRect(2);
  EXPECT_NE(without.copy(group.toAlignedRect()), with.copy(group.toAlignedRect()));
}

TEST_F(ComparePainterTest, PlacesAreFoundInEachGroup) {
  painted();
  for (const CompareGroup group : kAllCompareGroups) {
    const QPointF middle = geometry_.group(group).taxelRect(4, 3, 2).center();
    const auto place = geometry_.placeAt(middle);
    ASSERT_TRUE(place);
    EXPECT_EQ(place->group, group);
    EXPECT_EQ(place->taxel, (TaxelPlace{4, 3, 2}));
  }
  EXPECT_EQ(geometry_.placeAt({1.0, 1.0}), std::nullopt);
}

TEST(ComparePainter, ACaptionWithoutRoomGivesWayToAShorterOne) {
  const QFontMetricsF metrics{QFont()};
  CompareGroupContent content;
  content.caption = "mean +1.0 · rms 2.0 · largest +3 at the palm, x 1, y 2";
  content.shorterCaptions = {"mean +1.0 · rms 2.0 · largest +3", "mean +1.0 · rms 2.0"};
  const auto in = [&](const QString& asWideAs, double more = 0.0) {
    return fittingCaption(content, metrics.horizontalAdvance(asWideAs) + more, metrics);
  };
  EXPECT_EQ(in(content.caption), content.caption);
  EXPECT_EQ(in(content.caption, -1.0), content.shorterCaptions[0]);
  EXPECT_EQ(in(content.shorterCaptions[0], -1.0), content.shorterCaptions[1]);
  EXPECT_EQ(in("mean"), content.shorterCaptions[1]);
  content.shorterCaptions.clear();
  EXPECT_EQ(in("mean"), content.caption);
}

}  // namespace
}  // namespace palpate::gui::compare_painter_test

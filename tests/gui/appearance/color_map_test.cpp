#include "gui/appearance/color_map.h"

#include <cmath>
#include <limits>

#include "testing/testing.h"

namespace palpate::gui::color_map_test {
namespace {

void expectColor(QRgb color, int red, int green, int blue, int tolerance = 1) {
  EXPECT_NEAR(qRed(color), red, tolerance);
  EXPECT_NEAR(qGreen(color), green, tolerance);
  EXPECT_NEAR(qBlue(color), blue, tolerance);
}

// Ends and a middle as published by the maps' authors (matplotlib's tables).
TEST(ColorMap, HasThePublishedColours) {
  expectColor(colorTable(ColorMapName::kViridis)[3], 69, 5, 89, 0);
  expectColor(colorTable(ColorMapName::kViridis)[0], 68, 1, 84);
  expectColor(colorTable(ColorMapName::kViridis)[255], 253, 231, 37);
  expectColor(colorTable(ColorMapName::kInferno)[0], 0, 0, 4);
  expectColor(colorTable(ColorMapName::kInferno)[255], 252, 255, 164);
  expectColor(colorTable(ColorMapName::kMagma)[255], 252, 253, 191);
  expectColor(colorTable(ColorMapName::kPlasma)[0], 13, 8, 135);
  expectColor(colorTable(ColorMapName::kPlasma)[255], 240, 249, 33);
  expectColor(colorTable(ColorMapName::kTurbo)[0], 48, 18, 59);
  expectColor(colorTable(ColorMapName::kTurbo)[255], 122, 4, 3);
  expectColor(colorTable(ColorMapName::kGrey)[77], 77, 77, 77, 0);
}

double lightness(QRgb color) {
  const auto linear = [](int channel) {
    const double c = channel / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return std::cbrt(0.2126 * linear(qRed(color)) + 0.7152 * linear(qGreen(color)) +
                   0.0722 * linear(qBlue(color)));
}

TEST(ColorMap, UniformMapsGrowLighterFromEndToEnd) {
  for (const ColorMapName map : kAllColorMaps) {
    if (map == ColorMapName::kTurbo) continue;  // a rainbow by choice
    const ColorTable& table = colorTable(map);
    for (std::size_t i = 8; i < table.size(); i += 8)
      EXPECT_GT(lightness(table[i]), lightness(table[i - 8])) << nameOf(map) << ' ' << i;
  }
}

TEST(ColorMap, NamesReadBack) {
  for (const ColorMapName map : kAllColorMaps) EXPECT_EQ(colorMapFrom(nameOf(map)), map);
  EXPECT_EQ(colorMapFrom("jet"), std::nullopt);
}

TEST(ColorMap, IndexIsLinearAndClamped) {
  EXPECT_EQ(colorIndex(0, 0, 255), 0);
  EXPECT_EQ(colorIndex(51, 0, 255), 51);
  EXPECT_EQ(colorIndex(255, 0, 255), 255);
  EXPECT_EQ(colorIndex(4095, 0, 255), 255);
  EXPECT_EQ(colorIndex(-1, 0, 255), 0);
  EXPECT_EQ(colorIndex(150, 100, 200), 128);
  EXPECT_EQ(colorIndex(5, 7, 7), 0);
  EXPECT_EQ(colorIndex(std::numeric_limits<double>::quiet_NaN(), 0, 1), 0);
  EXPECT_EQ(colorIndex(std::numeric_limits<double>::infinity(), 0, 1), 255);
}

}  // namespace
}  // namespace palpate::gui::color_map_test

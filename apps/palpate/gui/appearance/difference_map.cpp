#include "gui/appearance/difference_map.h"

#include <array>
#include <cmath>

#include <palpate/core/number_text.h>

namespace palpate::gui {
namespace {

// Lightness 0..1, green to red, blue to yellow.
using Oklab = std::array<double, 3>;

double linear(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

double differenceMapEncoded(double channel) {
  return channel <= 0.0031308 ? channel * 12.92 : 1.055 * std::pow(channel, 1.0 / 2.4) - 0.055;
}

Oklab oklabOf(const QColor& color) {
  const double r = linear(color.redF()), g = linear(color.greenF()), b = linear(color.blueF());
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

QRgb rgbOf(const Oklab& color) {
  const auto cubed = [](double value) { return value * value * value; };
  const double l = cubed(color[0] + 0.3963377774 * color[1] + 0.2158037573 * color[2]);
  const double m = cubed(color[0] - 0.1055613458 * color[1] - 0.0638541728 * color[2]);
  const double s = cubed(color[0] - 0.0894841775 * color[1] - 1.2914855480 * color[2]);
  const auto byte = [](double channel) {
    return static_cast<int>(
        std::lround(255.0 * std::clamp(differenceMapEncoded(channel), 0.0, 1.0)));
  };
  return qRgb(byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
              byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
              byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s));
}

// The two ends of the map; both have the same lightness.
struct Ends {
  QColor b;
  QColor a;
};

Ends endsOf(Theme theme) {
  if (theme == Theme::kDark) return {"#58bcff", "#ffa038"};
  return {"#0062b4", "#b04400"};
}

ColorTable makeTable(Theme theme) {
  const Oklab middle = oklabOf(colorsOf(theme).taxel);
  const Ends ends = endsOf(theme);
  const Oklab b = oklabOf(ends.b), a = oklabOf(ends.a);
  ColorTable table{};
  constexpr std::size_t kHalf = 128;
  for (std::size_t step = 0; step < kHalf; ++step) {
    const double share = static_cast<double>(step) / static_cast<double>(kHalf - 1);
    const auto between = [&](const Oklab& end) {
      Oklab color{};
      for (std::size_t i = 0; i < color.size(); ++i)
        color[i] = middle[i] + share * (end[i] - middle[i]);
      return rgbOf(color);
    };
    table[kHalf + step] = between(a);
    table[kHalf - 1 - step] = between(b);
  }
  return table;
}

}  // namespace

QColor sideColor(CompareSide side, Theme theme) {
  const Ends ends = endsOf(theme);
  return side == CompareSide::kA ? ends.a : ends.b;
}

const ColorTable& differenceTable(Theme theme) {
  static const ColorTable dark = makeTable(Theme::kDark);
  static const ColorTable light = makeTable(Theme::kLight);
  return theme == Theme::kDark ? dark : light;
}

QString signedText(double value, int decimals) {
  const QString digits = QString::fromStdString(fixedText(std::abs(value), decimals));
  bool isZero = true;
  for (const QChar digit : digits) isZero = isZero && (digit == '0' || digit == '.');
  if (isZero) return digits;
  return (value < 0.0 ? QString("−") : QString("+")) + digits;
}

}  // namespace palpate::gui

#include "gui/matrices/heat_image.h"

#include <algorithm>
#include <cmath>

namespace palpate::gui {
namespace {

constexpr int kOpaque = 255;

struct Blend {
  // Weighted mean over the enabled neighbours.
  double value = 0.0;
  // Share of the weight that belongs to active taxels, 0..1.
  double activity = 0.0;
};

// Interpolates at (x, y) [taxels]; the centre of the first taxel is (0, 0).
Blend blendAt(const ConstMatrixMap& values,
              const MatrixLayout& layout,
              double y,
              double x,
              bool isSigned,
              double least) {
  const int y0 = static_cast<int>(std::floor(y));
  const int x0 = static_cast<int>(std::floor(x));
  double weights = 0.0;
  double sum = 0.0;
  double active = 0.0;
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      // Beyond the border the value of the border taxel is used.
      const int row = std::clamp(y0 + dy, 0, layout.rows - 1);
      const int column = std::clamp(x0 + dx, 0, layout.columns - 1);
      if (!layout.enabled(row, column)) continue;
      const double weight =
          (dy == 0 ? 1.0 - (y - y0) : y - y0) * (dx == 0 ? 1.0 - (x - x0) : x - x0);
      const auto value = static_cast<double>(values(row, column));
      weights += weight;
      sum += weight * value;
      if ((isTouched(value) && value >= least) || isSigned) active += weight;
    }
  }
  if (weights <= 0.0) return {};
  return {sum / weights, active / weights};
}

}  // namespace

QImage smoothHeatImage(const ConstMatrixMap& values,
                       const MatrixLayout& layout,
                       const HeatImageOptions& options) {
  const int scale = options.pixelsPerTaxel;
  QImage image(layout.columns * scale, layout.rows * scale, QImage::Format_ARGB32);
  image.fill(Qt::transparent);
  const bool isSigned = options.difference != nullptr;
  if (isSigned ? values.isZero(0.0F) : !isTouched(values.maxCoeff())) return image;
  const ColorTable& colors = isSigned ? *options.difference : colorTable(options.map);
  for (int py = 0; py < image.height(); ++py) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(py));
    for (int px = 0; px < image.width(); ++px) {
      if (!layout.enabled(py / scale, px / scale)) continue;
      const Blend blend = blendAt(values,
                                  layout,
                                  (py + 0.5) / scale - 0.5,
                                  (px + 0.5) / scale - 0.5,
                                  isSigned,
                                  options.least);
      if (blend.activity <= 0.0) continue;
      const int index = colorIndex(blend.value, options.rangeMin, options.rangeMax);
      const QRgb color = colors[static_cast<std::size_t>(index)];
      const int alpha = static_cast<int>(std::lround(blend.activity * kOpaque));
      line[px] = qRgba(qRed(color), qGreen(color), qBlue(color), alpha);
    }
  }
  return image;
}

QImage plainHeatImage(const ConstMatrixMap& values,
                      const MatrixLayout& layout,
                      const HeatImageOptions& options) {
  QImage image(layout.columns, layout.rows, QImage::Format_ARGB32);
  image.fill(Qt::transparent);
  const bool isSigned = options.difference != nullptr;
  const ColorTable& colors = isSigned ? *options.difference : colorTable(options.map);
  for (int y = 0; y < layout.rows; ++y) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
    for (int x = 0; x < layout.columns; ++x) {
      const auto value = static_cast<double>(values(y, x));
      if ((isSigned ? value == 0.0 : !(isTouched(value) && value >= options.least)) ||
          !layout.enabled(y, x))
        continue;
      line[x] =
          colors[static_cast<std::size_t>(colorIndex(value, options.rangeMin, options.rangeMax))];
    }
  }
  return image;
}

}  // namespace palpate::gui

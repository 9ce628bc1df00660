#include "gui/appearance/color_map.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace palpate::gui {
namespace {

constexpr int kLast = 255;

ColorTable greyTable() {
  ColorTable table{};
  for (int i = 0; i <= kLast; ++i) table[static_cast<std::size_t>(i)] = qRgb(i, i, i);
  return table;
}

ColorTable openCvTable(int map) {
  cv::Mat ramp(1, kLast + 1, CV_8UC1);
  for (int i = 0; i <= kLast; ++i) ramp.at<unsigned char>(0, i) = static_cast<unsigned char>(i);
  cv::Mat colored;
  cv::applyColorMap(ramp, colored, map);
  ColorTable table{};
  for (int i = 0; i <= kLast; ++i) {
    const auto& bgr = colored.at<cv::Vec3b>(0, i);  // OpenCV's order is blue, green, red
    table[static_cast<std::size_t>(i)] = qRgb(bgr[2], bgr[1], bgr[0]);
  }
  return table;
}

int openCvMap(ColorMapName map) {
  switch (map) {
    case ColorMapName::kViridis:
      return cv::COLORMAP_VIRIDIS;
    case ColorMapName::kMagma:
      return cv::COLORMAP_MAGMA;
    case ColorMapName::kPlasma:
      return cv::COLORMAP_PLASMA;
    case ColorMapName::kCividis:
      return cv::COLORMAP_CIVIDIS;
    case ColorMapName::kTurbo:
      return cv::COLORMAP_TURBO;
    case ColorMapName::kInferno:
    case ColorMapName::kGrey:
      break;
  }
  return cv::COLORMAP_INFERNO;
}

}  // namespace

const char* nameOf(ColorMapName map) {
  switch (map) {
    case ColorMapName::kViridis:
      return "viridis";
    case ColorMapName::kMagma:
      return "magma";
    case ColorMapName::kPlasma:
      return "plasma";
    case ColorMapName::kCividis:
      return "cividis";
    case ColorMapName::kTurbo:
      return "turbo";
    case ColorMapName::kGrey:
      return "grey";
    case ColorMapName::kInferno:
      break;
  }
  return "inferno";
}

std::optional<ColorMapName> colorMapFrom(std::string_view name) {
  for (const ColorMapName map : kAllColorMaps)
    if (name == nameOf(map)) return map;
  return std::nullopt;
}

const ColorTable& colorTable(ColorMapName map) {
  static const auto tables = [] {
    std::array<ColorTable, kAllColorMaps.size()> all{};
    for (const ColorMapName each : kAllColorMaps)
      all[static_cast<std::size_t>(each)] =
          each == ColorMapName::kGrey ? greyTable() : openCvTable(openCvMap(each));
    return all;
  }();
  return tables[static_cast<std::size_t>(map)];
}

int colorIndex(double value, double rangeMin, double rangeMax) {
  if (!(rangeMax > rangeMin)) return 0;
  const double fraction = (value - rangeMin) / (rangeMax - rangeMin);
  // Also for NaN.
  if (!(fraction > 0.0)) return 0;
  return static_cast<int>(std::lround(std::min(fraction, 1.0) * kLast));
}

}  // namespace palpate::gui

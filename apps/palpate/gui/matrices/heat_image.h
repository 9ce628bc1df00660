// Renders one matrix as a small image that the painter scales: smooth between taxels, or one pixel
// per taxel.
#pragma once

#include <QImage>

#include <palpate/model/matrix_layout.h>
#include <palpate/model/tactile_frame.h>

#include "gui/appearance/color_map.h"

namespace palpate::gui {

struct HeatImageOptions {
  ColorMapName map = ColorMapName::kInferno;
  double rangeMin = 0.0;  // [counts]
  double rangeMax = 1.0;
  // Values below this are at rest [counts].
  double least = 0.0;
  // Pixels per taxel of a smooth image.
  int pixelsPerTaxel = 8;
  // Colour table for signed values, used instead of `map` when set; then every enabled taxel is
  // drawn, whatever its sign.
  const ColorTable* difference = nullptr;
};

// Interpolates the values (not the colours) bilinearly between the centres of enabled taxels, not
// across disabled ones, and then colours them. The opacity is the interpolated share of active
// taxels, so a contact fades into the colour of taxels at rest. Disabled places are transparent.
QImage smoothHeatImage(const ConstMatrixMap& values,
                       const MatrixLayout& layout,
                       const HeatImageOptions& options);
// One pixel per place; active taxels are opaque, all others transparent.
QImage plainHeatImage(const ConstMatrixMap& values,
                      const MatrixLayout& layout,
                      const HeatImageOptions& options);

}  // namespace palpate::gui

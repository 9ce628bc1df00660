// One matrix as a small image, for drawing scaled: smooth between taxels, or one pixel per place.
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
  int pixelsPerTaxel = 8;  // of a smooth image
  // Of signed values, instead of `map`: every enabled taxel counts, whatever its sign.
  const ColorTable* difference = nullptr;
};

// Values are interpolated bilinearly between the centres of enabled taxels (not colours, and not
// across places without a taxel), then coloured. Opacity is the interpolated share of active
// taxels, so a contact fades into the colour of taxels at rest. Places that aren't enabled are
// transparent.
QImage smoothHeatImage(const ConstMatrixMap& values,
                       const MatrixLayout& layout,
                       const HeatImageOptions& options);
// One pixel per place; active taxels are opaque, everything else is transparent.
QImage plainHeatImage(const ConstMatrixMap& values,
                      const MatrixLayout& layout,
                      const HeatImageOptions& options);

}  // namespace palpate::gui

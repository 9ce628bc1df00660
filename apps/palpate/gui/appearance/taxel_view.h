// Which value of taxels with a sign or three components the views draw.
#pragma once

#include <array>

namespace palpate::gui {

// Normal: z, on a diverging colour map where the sensor has a sign. Magnitude: the length of x, y,
// z, on a sequential one.
enum class TaxelView { kNormal, kMagnitude };
inline constexpr std::array kAllTaxelViews = {TaxelView::kNormal, TaxelView::kMagnitude};
// The name in the header of the matrices, options and settings.
inline const char* nameOf(TaxelView view) {
  return view == TaxelView::kMagnitude ? "magnitude" : "normal";
}

// Factor of the arrows of shear; with 1 a shear as large as the upper end of the colour range is
// one taxel long. 0: no arrows.
inline constexpr double kUsualArrows = 2.0;
inline constexpr double kLongestArrows = 50.0;

}  // namespace palpate::gui

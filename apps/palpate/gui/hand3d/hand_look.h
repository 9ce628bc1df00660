// The settings of how the hand in 3-D is drawn.
#pragma once

#include <QSettings>
#include <QString>
#include <array>
#include <cstddef>
#include <optional>

#include "gui/appearance/color_map.h"
#include "gui/appearance/theme.h"
#include "gui/matrices/matrices_painter.h"

namespace palpate::gui {

// How taxels are drawn: as their surface, as bars along the normal, or as points; on the hand, or
// laid flat with the matrices side by side.
enum class TaxelShape { kCells, kBars, kPoints, kFlatCells, kFlatBars };
inline constexpr std::array kAllTaxelShapes = {TaxelShape::kCells,
                                               TaxelShape::kBars,
                                               TaxelShape::kPoints,
                                               TaxelShape::kFlatCells,
                                               TaxelShape::kFlatBars};
// "cells", "bars", ..: the name in menus and settings.
QString nameOf(TaxelShape shape);
bool isFlat(TaxelShape shape);

enum class SphereLook { kGlass, kOpaque, kWire, kNone };
inline constexpr std::array kAllSphereLooks = {
    SphereLook::kGlass, SphereLook::kOpaque, SphereLook::kWire, SphereLook::kNone};
QString nameOf(SphereLook look);

// What the enclosing sphere encloses.
enum class SphereOf { kTaxels, kCentroids };

struct HandLook {
  TaxelShape taxels = TaxelShape::kCells;
  SphereLook sphere = SphereLook::kGlass;
  SphereOf sphereOf = SphereOf::kTaxels;
  bool normals = false;
  // Draws the links as a wire frame.
  bool wire = false;
  // Draws centroids, principal axes and mean normals of the contacts.
  bool contacts = true;
  // Draws the motion of the contacts and the object, as measured by the dock Slip.
  bool slip = true;
  // Draws the axes of the hand's base frame.
  bool axes = false;
  // Shows one matrix alone; not stored in the settings.
  std::optional<std::size_t> only = {};
  // The same as in the heat maps.
  ColorMapName map = ColorMapName::kInferno;
  ValueRange range = {};
  TaxelView view = TaxelView::kNormal;
  bool isSigned = false;
  double arrows = kUsualArrows;
  Theme theme = Theme::kDark;
  bool operator==(const HandLook&) const = default;
};

// The look with what it has in common with the heat maps from another one.
HandLook withColorsOf(HandLook look, const HandLook& other);

// Load and store the look in the settings; values that make no sense become the defaults.
HandLook loadHandLook(const QSettings& settings);
void saveHandLook(const HandLook& look, QSettings& settings);

}  // namespace palpate::gui

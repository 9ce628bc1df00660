// How the hand in space is drawn.
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

// The taxels: on the hand or laid flat side by side, as their surface, as bars along the normal, as
// points.
enum class TaxelShape { kCells, kBars, kPoints, kFlatCells, kFlatBars };
inline constexpr std::array kAllTaxelShapes = {TaxelShape::kCells,
                                               TaxelShape::kBars,
                                               TaxelShape::kPoints,
                                               TaxelShape::kFlatCells,
                                               TaxelShape::kFlatBars};
QString nameOf(TaxelShape shape);  // "cells", "bars", ..: in menus and settings
bool isFlat(TaxelShape shape);

enum class SphereLook { kGlass, kOpaque, kWire, kNone };
inline constexpr std::array kAllSphereLooks = {
    SphereLook::kGlass, SphereLook::kOpaque, SphereLook::kWire, SphereLook::kNone};
QString nameOf(SphereLook look);

// What the sphere encloses.
enum class SphereOf { kTaxels, kCentroids };

struct HandLook {
  TaxelShape taxels = TaxelShape::kCells;
  SphereLook sphere = SphereLook::kGlass;
  SphereOf sphereOf = SphereOf::kTaxels;
  bool normals = false;
  bool wire = false;     // the links as a wire frame
  bool contacts = true;  // centroids, principal axes and mean normals of the contacts
  bool slip = true;      // how the contacts and the object move, where the dock Slip measures it
  bool axes = false;     // of the hand's base frame
  std::optional<std::size_t> only = {};  // one matrix alone; not remembered
  // Shared with the heat maps.
  ColorMapName map = ColorMapName::kInferno;
  ValueRange range = {};
  Theme theme = Theme::kDark;
  bool operator==(const HandLook&) const = default;
};

// What is remembered of it from day to day; what makes no sense in the settings is the default.
HandLook loadHandLook(const QSettings& settings);
void saveHandLook(const HandLook& look, QSettings& settings);

}  // namespace palpate::gui

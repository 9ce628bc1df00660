// Colour maps of the heat maps: 256 colours each. Perceptually uniform ones, so that equal steps in
// counts look equal, plus turbo and grey by choice.
#pragma once

#include <QColor>
#include <array>
#include <optional>
#include <string_view>

namespace palpate::gui {

enum class ColorMapName { kInferno, kViridis, kMagma, kPlasma, kCividis, kTurbo, kGrey };

inline constexpr std::array kAllColorMaps = {ColorMapName::kInferno,
                                             ColorMapName::kViridis,
                                             ColorMapName::kMagma,
                                             ColorMapName::kPlasma,
                                             ColorMapName::kCividis,
                                             ColorMapName::kTurbo,
                                             ColorMapName::kGrey};

using ColorTable = std::array<QRgb, 256>;

// "inferno", "viridis", ..; the word used in menus, settings and captions.
const char* nameOf(ColorMapName map);
std::optional<ColorMapName> colorMapFrom(std::string_view name);
// From the lowest value to the highest, opaque. Computed once.
const ColorTable& colorTable(ColorMapName map);
// Index into a table for a value in a range, clamped at both ends; 0 for an empty range.
int colorIndex(double value, double rangeMin, double rangeMax);

}  // namespace palpate::gui

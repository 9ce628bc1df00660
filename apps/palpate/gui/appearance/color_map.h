// The colour maps of the heat maps, 256 colours each. All but turbo and grey are perceptually
// uniform: equal steps in counts look equal.
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

// "inferno", "viridis", ..; the name in menus, settings and captions.
const char* nameOf(ColorMapName map);
std::optional<ColorMapName> colorMapFrom(std::string_view name);
// The opaque colours from the lowest value to the highest. Computed once.
const ColorTable& colorTable(ColorMapName map);
// Index into a colour table for a value in a range, clamped at both ends; 0 for an empty range.
int colorIndex(double value, double rangeMin, double rangeMax);

}  // namespace palpate::gui

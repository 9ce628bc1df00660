#include "gui/appearance/condition_color.h"

namespace palpate::gui {

QColor conditionColor(HandCondition condition, Theme theme) {
  const ThemeColors& colors = colorsOf(theme);
  const bool dark = theme == Theme::kDark;
  switch (condition) {
    case HandCondition::kReady:
      break;
    case HandCondition::kRelaxed:
      return dark ? "#e08fb0" : "#9c3d6b";
    case HandCondition::kMoving:
      return dark ? "#5eb8f0" : "#0b6aa8";
    case HandCondition::kEasing:
      return dark ? "#c4a5ff" : "#6b46b8";
    case HandCondition::kHolding:
      return dark ? "#c3d94e" : "#566400";
    case HandCondition::kWatched:
      return colors.accent;
    case HandCondition::kNotProtected:
      return colors.warning;
    case HandCondition::kStopped:
      return colors.text;
    case HandCondition::kGone:
      return colors.danger;
  }
  return colors.muted;
}

}  // namespace palpate::gui

// Colours of the conditions of a hand: of the chip in the tool bar, and of the border of the views.
#pragma once

#include <QColor>

#include <palpate/control/hand_condition.h>

#include "gui/appearance/theme.h"

namespace palpate::gui {

// A colour each; contrast of at least 4.5:1 on the window and on bars.
QColor conditionColor(HandCondition condition, Theme theme = shownTheme());

}  // namespace palpate::gui

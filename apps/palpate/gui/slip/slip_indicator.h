// The status symbol of a matrix in the dock Slip: whether its contact slips. The states differ in
// shape as well as in colour: a ring (off), a disc with a tick (ready), a triangle (unknown or
// ambiguous), a square with an arrow (slips).
#pragma once

#include <QColor>
#include <QIcon>
#include <QString>

#include <palpate/slip/slip_series.h>

#include "gui/appearance/theme.h"

namespace palpate::gui {

// The four symbols, in the order above.
enum class IndicatorLook { kOff, kReady, kUnsure, kSlipping };
// Null: the matrix is not touched.
IndicatorLook indicatorOf(const SlipSample* sample);
// Colour and icon of a symbol.
QColor colorOf(IndicatorLook look, Theme theme = shownTheme());
QIcon indicatorIcon(IndicatorLook look, Theme theme = shownTheme());
// "still", "load shift", ..; "no contact"
QString stateTextOf(const SlipSample* sample);
// Explains the state in one sentence.
QString meaningOf(const SlipSample* sample);

}  // namespace palpate::gui

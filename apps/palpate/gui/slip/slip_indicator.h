// The lamp of a matrix: whether it slips. Told apart by shape as well as by colour: a ring (off), a
// disc with a tick (ready), a triangle (nothing can be said, or it is ambiguous), a square with an
// arrow (slips).
#pragma once

#include <QColor>
#include <QIcon>
#include <QString>

#include <palpate/slip/slip_series.h>

#include "gui/appearance/theme.h"

namespace palpate::gui {

enum class IndicatorLook { kOff, kReady, kUnsure, kSlipping };
// Null: the matrix isn't touched.
IndicatorLook indicatorOf(const SlipSample* sample);
QColor colorOf(IndicatorLook look, Theme theme);
QIcon indicatorIcon(IndicatorLook look, Theme theme);
// "still", "load shift", ..; "no contact".
QString verdictOf(const SlipSample* sample);
// What the verdict means, in a sentence.
QString meaningOf(const SlipSample* sample);

}  // namespace palpate::gui

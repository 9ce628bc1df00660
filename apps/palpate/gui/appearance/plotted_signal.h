// The characteristic signals that the timeline can plot, with their names and units.
#pragma once

#include <QString>

#include <palpate/signals/characteristic_signals.h>

#include "gui/appearance/display_units.h"

namespace palpate::gui {

using PlottedSignal = SignalKind;
inline constexpr const auto& kAllPlottedSignals = kAllSignalKinds;

// "mean", "filtered mean", ..; also the key in the settings.
QString nameOf(PlottedSignal signal);
// One sentence for a tool tip, for example that the mean falls when another taxel is touched.
QString meaningOf(PlottedSignal signal);
// "taxels", "mm²", or the unit of the hand's values.
QString unitOf(PlottedSignal signal, const QString& handUnit);
// The same as it is shown: an area in the unit that the user chose.
ShownUnit shownUnit(PlottedSignal signal, const QString& handUnit, const DisplayUnits& units);
// The signal of this name; kSum for an unknown name.
PlottedSignal plottedSignalFrom(const QString& name);

}  // namespace palpate::gui

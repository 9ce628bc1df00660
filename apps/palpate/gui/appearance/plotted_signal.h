// The characteristic signals that the timeline can plot, with their names and units.
#pragma once

#include <QString>
#include <array>

#include <palpate/signals/characteristic_signals.h>

#include "gui/appearance/display_units.h"

namespace palpate::gui {

using PlottedSignal = SignalKind;
// With those that only matrices with readings have, in the order of signalKinds(true).
inline constexpr std::array kAllPlottedSignals = {PlottedSignal::kMean,
                                                  PlottedSignal::kFilteredMean,
                                                  PlottedSignal::kMaximum,
                                                  PlottedSignal::kMinimum,
                                                  PlottedSignal::kSum,
                                                  PlottedSignal::kActive,
                                                  PlottedSignal::kArea,
                                                  PlottedSignal::kX,
                                                  PlottedSignal::kY,
                                                  PlottedSignal::kZ,
                                                  PlottedSignal::kNorm};
// The signal, or the sum where a source has no components.
inline PlottedSignal plottable(PlottedSignal signal, bool withComponents) {
  return isComponent(signal) && !withComponents ? PlottedSignal::kSum : signal;
}

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

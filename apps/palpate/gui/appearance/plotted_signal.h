// The characteristic signals that the timeline can plot, with their names and units.
#pragma once

#include <QString>

#include <palpate/signals/characteristic_signals.h>

namespace palpate::gui {

using PlottedSignal = SignalKind;
inline constexpr const auto& kAllPlottedSignals = kAllSignalKinds;

// "mean", "filtered mean", ..; also the key in the settings.
QString nameOf(PlottedSignal signal);
// "counts", "taxels", "mm²".
QString unitOf(PlottedSignal signal);
// The signal of this name; kMean for an unknown name.
PlottedSignal plottedSignalFrom(const QString& name);

}  // namespace palpate::gui

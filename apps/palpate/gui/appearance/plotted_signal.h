// The characteristic signals that the timeline can plot, with their names and units.
#pragma once

#include <QString>

#include <palpate/signals/characteristic_signals.h>

namespace palpate::gui {

using PlottedSignal = SignalKind;
inline constexpr const auto& kAllPlottedSignals = kAllSignalKinds;

QString nameOf(PlottedSignal signal);  // "mean", "filtered mean", ..; also the key in the settings
QString unitOf(PlottedSignal signal);  // "counts", "taxels", "mm²"
PlottedSignal plottedSignalFrom(const QString& name);  // kMean for an unknown name

}  // namespace palpate::gui

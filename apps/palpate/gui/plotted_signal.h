// The characteristic signals that the timeline can plot, with their names and units.
#pragma once

#include <QString>
#include <array>

#include <palpate/filter/characteristic_signals.h>

namespace palpate::gui {

enum class PlottedSignal { kMean, kFilteredMean, kMaximum, kMinimum, kSum, kActive, kArea };

inline constexpr std::array kAllPlottedSignals = {PlottedSignal::kMean,
                                                  PlottedSignal::kFilteredMean,
                                                  PlottedSignal::kMaximum,
                                                  PlottedSignal::kMinimum,
                                                  PlottedSignal::kSum,
                                                  PlottedSignal::kActive,
                                                  PlottedSignal::kArea};

QString nameOf(PlottedSignal signal);  // "mean", "filtered mean", ..; also the key in the settings
QString unitOf(PlottedSignal signal);  // "counts", "taxels", "mm²"
PlottedSignal plottedSignalFrom(const QString& name);  // kMean for an unknown name
double valueOf(const CharacteristicSignals& values, PlottedSignal which);

}  // namespace palpate::gui

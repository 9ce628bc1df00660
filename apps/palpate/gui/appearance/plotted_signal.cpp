#include "gui/appearance/plotted_signal.h"

namespace palpate::gui {

QString nameOf(PlottedSignal signal) {
  switch (signal) {
    case PlottedSignal::kFilteredMean:
      return "filtered mean";
    case PlottedSignal::kMaximum:
      return "maximum";
    case PlottedSignal::kMinimum:
      return "minimum";
    case PlottedSignal::kSum:
      return "sum";
    case PlottedSignal::kActive:
      return "active taxels";
    case PlottedSignal::kArea:
      return "active area";
    case PlottedSignal::kMean:
      break;
  }
  return "mean";
}

QString unitOf(PlottedSignal signal, const QString& handUnit) {
  if (signal == PlottedSignal::kActive) return "taxels";
  if (signal == PlottedSignal::kArea) return "mm²";
  return handUnit;
}

PlottedSignal plottedSignalFrom(const QString& name) {
  for (const PlottedSignal signal : kAllPlottedSignals)
    if (name == nameOf(signal)) return signal;
  return PlottedSignal::kMean;
}

}  // namespace palpate::gui

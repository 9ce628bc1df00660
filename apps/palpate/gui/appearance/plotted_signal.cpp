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
    case PlottedSignal::kX:
      return "x";
    case PlottedSignal::kY:
      return "y";
    case PlottedSignal::kZ:
      return "z";
    case PlottedSignal::kNorm:
      return "norm";
    case PlottedSignal::kMean:
      break;
  }
  return "mean";
}

QString meaningOf(PlottedSignal signal) {
  switch (signal) {
    case PlottedSignal::kFilteredMean:
      return "Mean of the active taxels after smoothing over 3 x 3 taxels";
    case PlottedSignal::kMaximum:
      return "Largest taxel";
    case PlottedSignal::kMinimum:
      return "Smallest of the active taxels";
    case PlottedSignal::kSum:
      return "Sum of all taxels: steady when another taxel is touched";
    case PlottedSignal::kActive:
      return "Number of taxels that read more than 0";
    case PlottedSignal::kArea:
      return "Active taxels times the area of a taxel";
    case PlottedSignal::kX:
      return "Sum of the readings towards the next column, over the baseline";
    case PlottedSignal::kY:
      return "Sum of the readings towards the next row, over the baseline";
    case PlottedSignal::kZ:
      return "Sum of the readings into the surface, over the baseline, with their signs";
    case PlottedSignal::kNorm:
      return "Length of the vector of x, y and z";
    case PlottedSignal::kMean:
      break;
  }
  return "Mean of the active taxels: it falls when another taxel becomes active";
}

QString unitOf(PlottedSignal signal, const QString& handUnit) {
  if (signal == PlottedSignal::kActive) return "taxels";
  if (signal == PlottedSignal::kArea) return "mm²";
  return handUnit;
}

ShownUnit shownUnit(PlottedSignal signal, const QString& handUnit, const DisplayUnits& units) {
  if (signal == PlottedSignal::kArea) return shownUnit(units.area);
  return {unitOf(signal, handUnit)};
}

PlottedSignal plottedSignalFrom(const QString& name) {
  for (const PlottedSignal signal : kAllPlottedSignals)
    if (name == nameOf(signal)) return signal;
  return PlottedSignal::kSum;
}

}  // namespace palpate::gui

#include "gui/chart/plotted_curve.h"

#include "gui/appearance/plotted_signal.h"

namespace palpate::gui {
namespace {

constexpr double kPlottedCurveWidth = 1.4;
using PlottedCurveKind = SeriesChoice::Kind;

PlottedCurve curve(SeriesChoice choice,
                   const QString& name,
                   const QColor& color,
                   Qt::PenStyle style) {
  QPen pen(color, kPlottedCurveWidth, style);
  PlottedCurve made{std::move(choice), name, {}, {}, pen};
  made.unit = unitOf(made.choice);
  made.axis = axisNameOf(made.choice);
  return made;
}

}  // namespace

QString unitOf(const SeriesChoice& choice) {
  switch (choice.kind) {
    case PlottedCurveKind::kAngle:
      return "°";
    case PlottedCurveKind::kTemperature:
      return "°C";
    case PlottedCurveKind::kTaxels:
      return "counts";
    case PlottedCurveKind::kMatrix:
      break;
  }
  return unitOf(choice.signal);
}

QString axisNameOf(const SeriesChoice& choice) {
  switch (choice.kind) {
    case PlottedCurveKind::kAngle:
      return "joint angle in °";
    case PlottedCurveKind::kTemperature:
      return "temperature in °C";
    case PlottedCurveKind::kTaxels:
      return "taxels in counts";
    case PlottedCurveKind::kMatrix:
      break;
  }
  const QString name = nameOf(choice.signal);
  return name.endsWith(unitOf(choice.signal)) ? name : name + " in " + unitOf(choice.signal);
}

PlottedCurve matrixCurve(const HandDescription& hand,
                         std::size_t row,
                         SignalKind signal,
                         Theme theme) {
  const bool whole = row == hand.layout->numMatrices();
  return curve({.kind = PlottedCurveKind::kMatrix, .index = row, .signal = signal},
               whole ? QString("all") : QString::fromStdString(hand.matrixName(row)),
               whole ? wholeColor(theme) : matrixColor(row, theme),
               whole ? Qt::DashLine : Qt::SolidLine);
}

PlottedCurve taxelCurve(const TaxelSelection& taxels,
                        const QString& name,
                        std::size_t place,
                        Theme theme) {
  // The first curve has the accent colour, which marks selections in all views.
  const QColor color = place == 0 ? colorsOf(theme).accent : matrixColor(place + 1, theme);
  return curve({.kind = PlottedCurveKind::kTaxels, .taxels = taxels}, name, color, Qt::SolidLine);
}

PlottedCurve angleCurve(const HandDescription& hand, std::size_t axis, Theme theme) {
  return curve({.kind = PlottedCurveKind::kAngle, .index = axis},
               axis < hand.axes.size() ? QString::fromStdString(hand.axes[axis].name) + " joint"
                                       : "joint " + QString::number(axis),
               matrixColor(axis + 3, theme),
               Qt::DashLine);
}

PlottedCurve temperatureCurve(const HandDescription& hand, std::size_t sensor, Theme theme) {
  const auto& sensors = hand.temperatureSensors;
  return curve({.kind = PlottedCurveKind::kTemperature, .index = sensor},
               sensor < sensors.size() ? QString::fromStdString(sensors[sensor].name)
                                       : "sensor " + QString::number(sensor),
               matrixColor(sensor + 1, theme),
               Qt::DashDotLine);
}

}  // namespace palpate::gui

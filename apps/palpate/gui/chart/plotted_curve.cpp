#include "gui/chart/plotted_curve.h"

#include <cmath>

#include "gui/appearance/hand_unit.h"
#include "gui/appearance/plotted_signal.h"

namespace palpate::gui {
namespace {

constexpr double kPlottedCurveWidth = 1.4;
constexpr double kForceCurveWidth = 2.0;
constexpr std::size_t kMatrixColors = 6;
using PlottedCurveKind = SeriesChoice::Kind;

bool slides(const HandDescription& hand, std::size_t axis) {
  return axis < hand.axes.size() && hand.axes[axis].isSliding;
}

PlottedCurve curve(const HandDescription& hand,
                   SeriesChoice choice,
                   const QString& name,
                   const QColor& color,
                   Qt::PenStyle style,
                   const DisplayUnits& units) {
  QPen pen(color, kPlottedCurveWidth, style);
  PlottedCurve made{std::move(choice), name, {}, {}, pen, {}};
  const ShownUnit shown = shownUnit(made.choice, hand, units);
  made.unit = shown.symbol;
  made.axis = axisNameOf(made.choice, hand, units);
  made.baseUnit = unitOf(made.choice, hand);
  made.conversion = shown.conversion;
  return made;
}

}  // namespace

QString unitOf(const SeriesChoice& choice, const HandDescription& hand) {
  switch (choice.kind) {
    case PlottedCurveKind::kAngle:
      return slides(hand, choice.index) ? "mm" : "°";
    case PlottedCurveKind::kTemperature:
      return "°C";
    case PlottedCurveKind::kForce:
      return "N";
    case PlottedCurveKind::kFormula:  // FormulaCurve knows it
    case PlottedCurveKind::kColumn:   // Column does
      return {};
    case PlottedCurveKind::kTaxels:
      return unitOf(hand);
    case PlottedCurveKind::kMatrix:
      break;
  }
  return unitOf(choice.signal, unitOf(hand));
}

ShownUnit shownUnit(const SeriesChoice& choice,
                    const HandDescription& hand,
                    const DisplayUnits& units) {
  switch (choice.kind) {
    case PlottedCurveKind::kAngle:
      return slides(hand, choice.index) ? ShownUnit{"mm"} : shownUnit(units.angle);
    case PlottedCurveKind::kTemperature:
      return shownUnit(units.temperature);
    case PlottedCurveKind::kMatrix:
      return shownUnit(choice.signal, unitOf(hand), units);
    default:
      return {unitOf(choice, hand)};
  }
}

QString axisNameOf(const SeriesChoice& choice,
                   const HandDescription& hand,
                   const DisplayUnits& units) {
  const QString unit = shownUnit(choice, hand, units).symbol;
  switch (choice.kind) {
    case PlottedCurveKind::kAngle:
      return (slides(hand, choice.index) ? "joint position in " : "joint angle in ") + unit;
    case PlottedCurveKind::kTemperature:
      return "temperature in " + unit;
    case PlottedCurveKind::kForce:
      return "force in N";
    case PlottedCurveKind::kFormula:
      return "formulas";
    case PlottedCurveKind::kColumn:
      return QString::fromStdString(choice.series);
    case PlottedCurveKind::kTaxels:
      return "taxels in " + unit;
    case PlottedCurveKind::kMatrix:
      break;
  }
  const QString name = nameOf(choice.signal);
  return name.endsWith(unit) ? name : name + " in " + unit;
}

PlottedCurve matrixCurve(const HandDescription& hand,
                         std::size_t row,
                         SignalKind signal,
                         const DisplayUnits& units) {
  const bool whole = row == hand.layout->numMatrices();
  return curve(hand,
               {.kind = PlottedCurveKind::kMatrix, .index = row, .signal = signal},
               whole ? QString("all") : QString::fromStdString(hand.matrixName(row)),
               whole ? wholeColor() : matrixColor(row),
               whole ? Qt::DashLine : Qt::SolidLine,
               units);
}

PlottedCurve taxelCurve(const HandDescription& hand,
                        const TaxelSelection& taxels,
                        const QString& name,
                        std::size_t place) {
  // The first curve has the accent colour, which marks selections in all views.
  // The others have colours of matrices, but not their solid line; through its gaps the curve of
  // the same taxels, when they are chosen, stays visible.
  const bool first = place == 0;
  return curve(hand,
               {.kind = PlottedCurveKind::kTaxels, .taxels = taxels},
               name,
               first ? colorsOf().accent : matrixColor(place + 1),
               first ? Qt::SolidLine : Qt::DashDotDotLine,
               {});
}

PlottedCurve angleCurve(const HandDescription& hand, std::size_t axis, const DisplayUnits& units) {
  return curve(hand,
               {.kind = PlottedCurveKind::kAngle, .index = axis},
               axis < hand.axes.size() ? QString::fromStdString(hand.axes[axis].name) + " joint"
                                       : "joint " + QString::number(axis),
               matrixColor(axis + 3),
               Qt::DashLine,
               units);
}

PlottedCurve temperatureCurve(const HandDescription& hand,
                              std::size_t sensor,
                              const DisplayUnits& units) {
  const auto& sensors = hand.temperatureSensors;
  return curve(hand,
               {.kind = PlottedCurveKind::kTemperature, .index = sensor},
               sensor < sensors.size() ? QString::fromStdString(sensors[sensor].name)
                                       : "sensor " + QString::number(sensor),
               matrixColor(sensor + 1),
               Qt::DashDotLine,
               units);
}

QString nameOf(const SeriesDescription& series, const Column& column) {
  return QString::fromStdString(series.name + " " + column.name);
}

QString unitOf(const Column& column) {
  return column.unit == "deg"    ? QString("°")
         : column.unit == "degC" ? QString("°C")
                                 : QString::fromStdString(column.unit);
}

std::vector<SeriesDescription> furtherSeriesOf(const Profile& profile) {
  return {profile.series().begin() + kHandSeries, profile.series().end()};
}

PlottedCurve columnCurve(const SeriesDescription& series, std::size_t column, std::size_t place) {
  const Column& of = series.columns.at(column);
  const QString unit = unitOf(of), name = QString::fromStdString(series.name);
  const QList<QList<qreal>> patterns = {
      {8, 2, 2, 2, 2, 2}, {8, 2, 5, 2}, {6, 2, 2, 2, 2, 2, 2, 2}, {8, 3, 8, 3, 2, 3}};
  QPen pen(matrixColor(place + 4), kPlottedCurveWidth);
  pen.setDashPattern(patterns[place / kMatrixColors % static_cast<std::size_t>(patterns.size())]);
  return {{.kind = PlottedCurveKind::kColumn, .series = series.name, .column = of.name},
          nameOf(series, of),
          unit,
          unit.isEmpty() ? name : name + " in " + unit,
          pen,
          unit};
}

PlottedCurve computedCurve(const HandDescription& hand,
                           const ComputedSeries& series,
                           std::size_t column,
                           const DisplayUnits& units) {
  PlottedCurve made = columnCurve(series.description, column, 0);
  const bool whole = series.matrix == hand.layout->numMatrices();
  made.name = QString::fromStdString(series.captions.at(column)) +
              (whole ? QString(" of the whole hand")
                     : " on " + QString::fromStdString(hand.matrixName(series.matrix)));
  if (made.unit == "kPa") {
    const ShownUnit shown = shownUnit(units.pressure);
    made.unit = shown.symbol;
    made.conversion = shown.conversion;
  }
  made.axis = (series.kind == ComputedKind::kForce      ? "force in "
               : series.kind == ComputedKind::kPressure ? "pressure in "
               : made.unit == "mm"                      ? "length in "
                                                        : "speed in ") +
              made.unit;
  made.pen.setColor(whole ? wholeColor() : matrixColor(series.matrix));
  // Each kind and column has a different dash; the line of the matrices is solid.
  const auto kind = static_cast<qreal>(series.kind), part = static_cast<qreal>(column);
  made.pen.setDashPattern({4 + 3 * kind, 2, 1 + part, 2});
  return made;
}

PlottedCurve forceCurve(const HandDescription& hand, std::size_t row) {
  const bool whole = row == hand.layout->numMatrices();
  PlottedCurve made = curve(
      hand,
      {.kind = PlottedCurveKind::kForce, .index = row},
      (whole ? QString("whole hand") : QString::fromStdString(hand.matrixName(row))) + " force",
      whole ? wholeColor() : matrixColor(row),
      Qt::DotLine,
      {});
  made.pen.setWidthF(kForceCurveWidth);
  return made;
}

PlottedCurve formulaCurve(const SeriesChoice& choice,
                          const QString& name,
                          const QString& unit,
                          std::size_t place) {
  constexpr double kFormulaCurveWidth = 1.8;
  return {choice,
          name,
          unit,
          unit.isEmpty() ? QString("formulas") : "formulas in " + unit,
          QPen(matrixColor(place + 2), kFormulaCurveWidth),
          unit};
}

void distinguish(PlottedCurve& formula, std::size_t place, const std::vector<PlottedCurve>& shown) {
  // Lengths of lines and gaps, in widths of the pen; the first is a solid line.
  const QList<QList<qreal>> patterns = {{}, {10, 2}, {10, 2, 2, 2}, {10, 2, 2, 2, 2, 2}, {3, 1}};
  for (const QList<qreal>& pattern : patterns)
    for (std::size_t i = 0; i < kMatrixColors; ++i) {
      QPen pen(matrixColor(place + 2 + i), formula.pen.widthF());
      if (!pattern.isEmpty()) pen.setDashPattern(pattern);
      const bool taken = std::any_of(shown.begin(), shown.end(), [&](const PlottedCurve& each) {
        return each.pen.color() == pen.color() && each.pen.style() == pen.style() &&
               each.pen.dashPattern() == pen.dashPattern();
      });
      formula.pen = pen;
      if (!taken) return;
    }
}

namespace {

int decimalsOf(const PlottedCurve& curve) {
  switch (curve.choice.kind) {
    case PlottedCurveKind::kMatrix:
      return 0;
    case PlottedCurveKind::kForce:
      return 2;
    default:
      return 1;
  }
}

}  // namespace

QString readingOf(const PlottedCurve& curve, std::optional<double> value) {
  if (!value || std::isnan(*value)) return "–";
  constexpr int kFormulaDigits = 5;
  if (curve.choice.kind == PlottedCurveKind::kFormula ||
      curve.choice.kind == PlottedCurveKind::kColumn)
    return (QString::number(*value, 'g', kFormulaDigits) + " " + curve.unit).trimmed();
  const UnitConversion& to = curve.conversion;
  return QString::number(to.of(*value), 'f', decimalsOf(curve) + to.moreDecimals) + " " +
         curve.unit;
}

QString differenceOf(const PlottedCurve& curve, std::optional<double> difference) {
  if (!difference) return "–";
  PlottedCurve ofDifferences = curve;
  ofDifferences.conversion.offset = 0.0;
  const QString size = readingOf(ofDifferences, std::abs(*difference));
  return (*difference < 0.0 ? "−" : "+") + size;
}

PlottedCurve inBaseUnit(PlottedCurve curve) {
  curve.unit = curve.baseUnit;
  curve.conversion = {};
  return curve;
}

QString readingsText(
    const QString& heading,
    const std::vector<PlottedCurve>& curves,
    const std::function<std::optional<double>(const SeriesChoice&)>& valueOfCurve) {
  QString text = heading;
  for (const PlottedCurve& curve : curves)
    text += "\n" + curve.name + "  " + readingOf(curve, valueOfCurve(curve.choice));
  return text;
}

}  // namespace palpate::gui

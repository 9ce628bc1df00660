// Describes a curve of the timeline: which series it shows, its name, unit, axis and colour. Values
// of the series are in base units; `conversion` makes what is shown.
#pragma once

#include <QPen>
#include <QString>
#include <functional>
#include <optional>
#include <vector>

#include <palpate/computed/computed_series.h>
#include <palpate/model/hand_description.h>
#include <palpate/signals/profile_series.h>

#include "gui/appearance/display_units.h"
#include "gui/appearance/theme.h"

namespace palpate::gui {

struct PlottedCurve {
  SeriesChoice choice;
  // "finger 0 distal", "thumb tip", "finger 1 distal (joint)", "motor 3", "wrist fz"
  QString name;
  // As shown: "counts", "°C", "K", "N"; curves of one unit share an axis.
  QString unit;
  // Name of the axis: "mean in counts", "joint angle in °".
  QString axis;
  QPen pen;
  // The unit of the series, which tables and files have: "°C", never "K".
  QString baseUnit;
  // From baseUnit to unit.
  UnitConversion conversion = {};
};

// The base unit of a series: "counts", "mm²", "°", "°C", "N"; empty for a column of a further
// series and a formula, of which the choice doesn't tell it.
QString unitOf(const SeriesChoice& choice, const HandDescription& hand);
ShownUnit shownUnit(const SeriesChoice& choice,
                    const HandDescription& hand,
                    const DisplayUnits& units);
// Name of the axis: "mean in counts", "taxels in counts", "joint angle in °", "joint position in
// mm", "temperature in °C", "force in N".
QString axisNameOf(const SeriesChoice& choice,
                   const HandDescription& hand,
                   const DisplayUnits& units = {});

PlottedCurve matrixCurve(const HandDescription& hand,
                         std::size_t row,
                         SignalKind signal,
                         const DisplayUnits& units = {});
// `place`: index among the taxel curves, which decides the colour and, for all but the first, which
// is that of the chosen taxels, a broken line.
PlottedCurve taxelCurve(const HandDescription& hand,
                        const TaxelSelection& taxels,
                        const QString& name,
                        std::size_t place);
PlottedCurve angleCurve(const HandDescription& hand,
                        std::size_t axis,
                        const DisplayUnits& units = {});
PlottedCurve temperatureCurve(const HandDescription& hand,
                              std::size_t sensor,
                              const DisplayUnits& units = {});
// A column of a further series. `place`: index among all such columns, which decides colour and
// dashes: no two of 24 columns have both, and no other curve has one of these dashes.
PlottedCurve columnCurve(const SeriesDescription& series, std::size_t column, std::size_t place);
// A column of a computed series: "force on finger 0 distal", "sphere diameter of the whole hand".
PlottedCurve computedCurve(const HandDescription& hand,
                           const ComputedSeries& series,
                           std::size_t column,
                           const DisplayUnits& units = {});
// "wrist fz"
QString nameOf(const SeriesDescription& series, const Column& column);
// As it is shown: "°" for "deg", "°C" for "degC".
QString unitOf(const Column& column);
// Those beside the series of the hand.
std::vector<SeriesDescription> furtherSeriesOf(const Profile& profile);
// `row`: a matrix, or the number of matrices for the whole hand.
PlottedCurve forceCurve(const HandDescription& hand, std::size_t row);

// A curve by a formula, which computes with base units; `place`: index among these curves, which
// decides the colour.
PlottedCurve formulaCurve(const SeriesChoice& choice,
                          const QString& name,
                          const QString& unit,
                          std::size_t place);
// Gives the curve of a formula a colour or a broken line that none of the shown curves has.
void distinguish(PlottedCurve& formula, std::size_t place, const std::vector<PlottedCurve>& shown);

// "812 counts", "31.4 °", "0.52 N"; "–" for no value. `value` is in the base unit.
QString readingOf(const PlottedCurve& curve, std::optional<double> value);
// As readingOf(), always with a sign: "+134 counts", "−2.0 °".
QString differenceOf(const PlottedCurve& curve, std::optional<double> difference);
// The curve in the base unit of its series, for tables and files.
PlottedCurve inBaseUnit(PlottedCurve curve);
// A heading and, below it, name and value of each curve; for tool tips.
QString readingsText(const QString& heading,
                     const std::vector<PlottedCurve>& curves,
                     const std::function<std::optional<double>(const SeriesChoice&)>& valueOfCurve);

}  // namespace palpate::gui

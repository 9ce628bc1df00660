// Describes a curve of the timeline: which series it shows, its name, unit, axis and colour.
#pragma once

#include <QPen>
#include <QString>
#include <vector>

#include <palpate/model/hand_description.h>
#include <palpate/signals/profile_series.h>

#include "gui/appearance/theme.h"

namespace palpate::gui {

struct PlottedCurve {
  SeriesChoice choice;
  QString name;  // "finger 0 distal", "thumb tip", "finger 1 distal (joint)", "motor 3"
  // "counts", "°C"; curves of one unit share an axis.
  QString unit;
  // Name of the axis: "mean in counts", "joint angle in °".
  QString axis;
  QPen pen;
};

QString unitOf(const SeriesChoice& choice, const HandDescription& hand);
// Name of the axis: "mean in counts", "taxels in counts", "joint angle in °", "joint position in
// mm", "temperature in °C".
QString axisNameOf(const SeriesChoice& choice, const HandDescription& hand);

PlottedCurve matrixCurve(const HandDescription& hand,
                         std::size_t row,
                         SignalKind signal,
                         Theme theme);
// `place`: index among the taxel curves, which decides the colour.
PlottedCurve taxelCurve(const HandDescription& hand,
                        const TaxelSelection& taxels,
                        const QString& name,
                        std::size_t place,
                        Theme theme);
PlottedCurve angleCurve(const HandDescription& hand, std::size_t axis, Theme theme);
PlottedCurve temperatureCurve(const HandDescription& hand, std::size_t sensor, Theme theme);

}  // namespace palpate::gui

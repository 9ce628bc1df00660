// The common style of all charts: axes, curves, shaded spans and their names.
#pragma once

#include <QColor>
#include <QPen>
#include <QString>
#include <cstddef>

#include "gui/appearance/plotted_signal.h"
#include "gui/appearance/theme.h"

class QCPAxis;
class QCPItemRect;
class QCPItemText;
class QCustomPlot;
class QWidget;

namespace palpate::gui {

// QWheelEvent::angleDelta() of one notch of the mouse wheel.
inline constexpr double kWheelNotch = 120.0;
// Zoom factor per notch.
inline constexpr double kWheelZoom = 1.25;

// Height of a chart in which curves can be read, with the numbers below it [lines of text].
inline constexpr int kMinChartLines = 5;

// Sets up the numbers, ticks and margins of both axes; called once per chart.
void arrangeChart(QCustomPlot& plot);
// The space left of a chart over time [px]: the same in each chart, so that their time axes begin
// at the same place.
int timeAxisLeft(const QWidget& plot);
// Gives background and axes the colours of the theme that is shown.
void styleChart(QCustomPlot& plot);
// A pen for a line of `length` in a legend, which shows one whole period of custom dashes; other
// lines are as they are.
QPen legendPen(QPen pen, double length);
// The pen of a matrix; that of all matrices together (`whole`) is dashed.
QPen curvePen(std::size_t matrix, bool whole);
// "mean in counts"; in a low chart only the unit.
QString signalAxisName(PlottedSignal signal,
                       const QString& handUnit,
                       const QWidget& plot,
                       const DisplayUnits& units = {});
// The whole name of an axis, whose label may be shorter where the chart is low.
inline constexpr const char* kWholeNameProperty = "wholeName";
// The long name of an axis or, if the chart is too low for it, the short one; empty if that is cut,
// too.
QString fittingName(const QString& name, const QString& shortName, const QWidget& plot);
// Whether the chart is too low for a title below its horizontal axis.
bool isLow(const QWidget& plot);
// Adds a unit in a corner of the plot, where the title of its axis has no room.
QCPItemText* unitInCorner(QCustomPlot& plot, const QString& unit, Qt::Alignment corner);
// Styles an additional vertical axis.
void styleExtraAxis(QCPAxis& axis, const QWidget& plot);
// Adds a shade over a span of time [s], behind the curves.
QCPItemRect* shadeSpan(QCustomPlot& plot, double beginS, double endS);
// The same for a gap, with edges: gaps that follow one another are told apart.
QCPItemRect* shadeGap(QCustomPlot& plot, double beginS, double endS);
// Adds a text at the top of the chart, at the time `atS` [s].
QCPItemText* wordAt(
    QCustomPlot& plot, double atS, const QString& text, Qt::Alignment side, const QColor& color);

}  // namespace palpate::gui

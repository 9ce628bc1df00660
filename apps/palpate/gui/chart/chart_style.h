// What the charts have in common: axes, curves, spans and their names.
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

// Of the mouse's wheel.
inline constexpr double kWheelNotch = 120.0;  // QWheelEvent::angleDelta() of one notch
inline constexpr double kWheelZoom = 1.25;    // per notch

// Numbers of both axes, their ticks and margins; once.
void arrangeChart(QCustomPlot& plot);
// Background and axes in the colours of a theme.
void styleChart(QCustomPlot& plot, Theme theme);
// Of a matrix; of all matrices together (`whole`) dashed.
QPen curvePen(std::size_t matrix, bool whole, Theme theme);
// "mean in counts"; a low chart has no room for more than the unit.
QString signalAxisName(PlottedSignal signal, const QWidget& plot);
// The long name of an axis, or, where the chart is too low for it, the short one.
QString fittingName(const QString& name, const QString& shortName, const QWidget& plot);
// An axis beside the first one.
void styleExtraAxis(QCPAxis& axis, const QWidget& plot, Theme theme);
// A shade over a span of time, behind the curves.
QCPItemRect* shadeSpan(QCustomPlot& plot, double beginS, double endS, Theme theme);
// A word at the top of the chart.
QCPItemText* wordAt(
    QCustomPlot& plot, double atS, const QString& text, Qt::Alignment side, const QColor& color);

}  // namespace palpate::gui

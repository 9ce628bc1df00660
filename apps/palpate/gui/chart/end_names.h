// Names of curves beside their right ends, each in the colour of its curve: a reader needs no
// legend.
#pragma once

#include <vector>

#include "gui/chart/plotted_curve.h"

class QCustomPlot;
class QPainter;

namespace palpate::gui {

// The margin right of the plot that the names need [px]; 0: they are not shown, because the chart
// is narrow or low, or has curves of several units, whose axes stand there.
int roomForEndNames(const QCustomPlot& plot, const std::vector<PlottedCurve>& curves);
// Paints them over a plot whose graphs are these curves. Names of ends that are near one another
// stand below one another.
void paintEndNames(QPainter& painter, QCustomPlot& plot, const std::vector<PlottedCurve>& curves);

}  // namespace palpate::gui

// A chart as a picture of its own: with its legend, in the colours of the screen or of paper.
#pragma once

#include <QColor>
#include <QPen>
#include <QString>
#include <vector>

#include "gui/picture/exported_view.h"

class QCustomPlot;
class QPainter;

namespace palpate::gui {

struct ChartLegendEntry {
  QString name;
  QPen pen;  // as on screen
};

struct ChartPictureOptions {
  QString title = {};    // top left
  QString caption = {};  // top right
  // Empty: the chart's graphs that have a name of their own.
  std::vector<ChartLegendEntry> legend = {};
};

// What a colour of either theme becomes on paper: the light theme's, or darkened until it can be
// seen on white.
QColor inkOf(const QColor& color);

// The chart itself is as before afterwards. In the window's thread.
void paintChart(QPainter& painter,
                const PictureLook& look,
                QCustomPlot& plot,
                const ChartPictureOptions& options);

}  // namespace palpate::gui

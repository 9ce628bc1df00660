// Paints a chart as a picture for export: with its legend, in the colours of the screen or of
// paper.
#pragma once

#include <QColor>
#include <QPen>
#include <QString>
#include <optional>
#include <vector>

#include "gui/chart/plot.h"
#include "gui/picture/exported_view.h"

class QPainter;

namespace palpate::gui {

struct ChartLegendEntry {
  QString name;
  // The pen as on screen.
  QPen pen;
  // Of points instead of a line: their form as on screen.
  std::optional<QCPScatterStyle> points = {};
};

struct ChartPictureOptions {
  // At the top left.
  QString title = {};
  // At the top right.
  QString caption = {};
  // Empty: the legend lists the graphs of the chart that have a name.
  std::vector<ChartLegendEntry> legend = {};
};

// Converts a colour of either theme for paper: into that of the light theme, or darkened until it
// is visible on white.
QColor inkOf(const QColor& color);

// Paints the chart, which looks as before afterwards. To be called in the thread of the window.
// Where the look leaves the axes no room beside their numbers and the legend, the whole picture is
// painted smaller, texts and lines too. Returns the place of its axes in the picture, in units.
QRectF paintChart(QPainter& painter,
                  const PictureLook& look,
                  QCustomPlot& plot,
                  const ChartPictureOptions& options);

}  // namespace palpate::gui

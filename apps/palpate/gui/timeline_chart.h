// The overview chart: chosen signals over the time of the recording, gaps shaded, and a cursor that
// moves without redrawing the curves. A click or drag seeks, the wheel zooms, the middle button (or
// Shift) pans, a double click shows everything.
#pragma once

#include <vector>

#include <qcustomplot.h>

#include "gui/opened_recording.h"
#include "gui/plotted_signal.h"
#include "gui/theme.h"

namespace palpate::gui {

class TimelineChart : public QCustomPlot {
  Q_OBJECT
 public:
  explicit TimelineChart(QWidget* parent = nullptr);

  void setRecording(const OpenedRecordingPtr& recording);  // null: empty
  void setSignal(PlottedSignal signal);
  // Per matrix and, last, the whole hand.
  void setPlotted(const std::vector<bool>& plotted);
  void setTheme(Theme theme);
  // Moves the cursor; a view that is zoomed in turns the page when the cursor leaves it.
  void setPosition(double seconds);

  void fit();
  void zoom(double factor);  // about the middle; above 1: closer
  void zoomAbout(double seconds, double factor);
  QCPRange seen() const { return xAxis->range(); }
  double secondsAt(double pixel) const { return xAxis->pixelToCoord(pixel); }
  double pixelOf(double seconds) const { return xAxis->coordToPixel(seconds); }
  int cursorPixel() const { return cursor_->x() + cursor_->width() / 2; }

  QSize sizeHint() const override { return {900, 210}; }
  QSize minimumSizeHint() const override { return {240, 110}; }

 signals:
  void sought(double seconds);

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

 private:
  double durationS() const;
  void setSeen(double from, double to);
  void rebuildGraphs();
  void refill();
  void nameAxis();
  void placeCursor();
  void showGapLabels();
  QString valuesAt(double seconds) const;

  OpenedRecordingPtr recording_;
  PlottedSignal signal_ = PlottedSignal::kMean;
  std::vector<bool> plotted_;
  Theme theme_ = Theme::kDark;
  std::vector<std::size_t> graphRows_;            // row of each graph
  std::vector<std::vector<double>> graphValues_;  // of each graph, one per frame
  std::vector<QCPItemText*> gapLabels_;           // one per gap
  QWidget* cursor_;
  double positionS_ = 0.0;
  bool panning_ = false;
  double panFromPixel_ = 0.0;
  QCPRange panFrom_;
};

}  // namespace palpate::gui

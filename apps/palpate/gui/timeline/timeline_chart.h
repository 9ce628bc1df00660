// The chart of a recording: chosen curves over time, an axis for each unit, gaps shaded, a cursor
// that moves without redrawing them, and a selection with handles. A click seeks, a drag selects, a
// drag along the axis scrubs; the wheel zooms, the middle button (or Shift) pans, a double click
// shows everything.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include <palpate/model/time_span.h>

#include "gui/appearance/theme.h"
#include "gui/chart/plot.h"
#include "gui/chart/plotted_curve.h"
#include "gui/source/opened_recording.h"
#include "gui/timeline/series_store.h"

namespace palpate::gui {

class TimelineChart : public QCustomPlot {
  Q_OBJECT
 public:
  explicit TimelineChart(QWidget* parent = nullptr);

  void setRecording(const OpenedRecordingPtr& recording);  // null: empty
  // Those that the recording hasn't stay empty.
  void setCurves(const std::vector<PlottedCurve>& curves);
  const std::vector<PlottedCurve>& curves() const noexcept { return curves_; }
  SeriesStore& store() noexcept { return store_; }
  // The same recording as it was before filters: its curves stand faintly behind. Null, or a long
  // one: none.
  void setBefore(const OpenedRecordingPtr& before);
  SeriesStore& storeBefore() noexcept { return before_; }
  void setTheme(Theme theme);
  // Moves the cursor; a view that is zoomed in turns the page when the cursor leaves it.
  void setPosition(double seconds);

  void fit();
  void zoom(double factor);  // about the cursor where it is seen, else the middle; above 1: closer
  void zoomAbout(double seconds, double factor);
  void showSpan(const TimeSpan& span);  // with a little air
  void setVisibleRange(double from, double to);
  QCPRange seen() const { return xAxis->range(); }
  double durationS() const;
  double secondsAt(double pixel) const { return xAxis->pixelToCoord(pixel); }
  double pixelOf(double seconds) const { return xAxis->coordToPixel(seconds); }
  int cursorPixel() const { return cursor_->x() + cursor_->width() / 2; }

  const std::optional<TimeSpan>& selection() const noexcept { return selection_; }
  // Clamped to the recording; nothing: none.
  void setSelection(std::optional<TimeSpan> span);

  QSize sizeHint() const override { return {900, 210}; }
  QSize minimumSizeHint() const override { return {240, 90}; }

 signals:
  void seekRequested(double seconds);
  void selectionChanged();
  // What is seen, or where its pixels lie, has changed.
  void seenChanged();
  void menuRequested(const QPoint& globalPosition);

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

 private:
  enum class Drag { kNone, kPan, kScrub, kSelect, kFrom, kTo };

  void rebuildGraphs();
  QCPAxis* axisFor(const PlottedCurve& curve);
  void nameAxes();
  void nameTime();
  void refill();
  void scaleAxes();
  void placeCursor();
  void placeSelection();
  void showGapLabels();
  Drag dragAt(const QPointF& at) const;
  void dragTo(const QPointF& at);
  QString valuesAt(double seconds) const;

  OpenedRecordingPtr recording_;
  SeriesStore store_;
  SeriesStore before_;      // of what stands behind
  bool hasBefore_ = false;  // something does
  std::vector<PlottedCurve> curves_;
  std::map<QString, QCPAxis*> axes_;  // by unit
  std::map<QString, QString> axisNames_;
  Theme theme_ = Theme::kDark;
  QSharedPointer<QCPAxisTicker> secondsTicker_;
  QSharedPointer<QCPAxisTickerTime> clockTicker_;
  std::vector<Gap> gaps_;
  std::vector<QCPItemText*> gapLabels_;  // one per gap
  QWidget* cursor_;
  QWidget* shade_;  // of the selection
  QWidget* handles_[2];
  double positionS_ = 0.0;
  std::optional<TimeSpan> selection_;
  Drag drag_ = Drag::kNone;
  QPointF pressedAt_;
  double pressedS_ = 0.0;
  QCPRange panFrom_;
};

}  // namespace palpate::gui

// The chart of a recording: chosen curves over time, one axis per unit, shaded gaps, a cursor that
// moves without redrawing the curves, and a selection with handles. A click seeks, a drag selects,
// a drag along the axis moves the cursor; the wheel zooms, the middle button (or Shift) pans, a
// double click shows everything. Vertical axes are automatic, or set by hand (UnitAxes).
#pragma once

#include <QPointer>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/model/timing.h>

#include "gui/chart/chart.h"
#include "gui/chart/plotted_curve.h"
#include "gui/chart/span_overlay.h"
#include "gui/chart/unit_axes.h"
#include "gui/source/opened_recording.h"
#include "gui/timeline/series_store.h"

class QLabel;

namespace palpate::gui {

class TimelineChart : public Chart {
  Q_OBJECT
 public:
  explicit TimelineChart(QWidget* parent = nullptr);

  // Null: the chart is empty.
  void setRecording(const OpenedRecordingPtr& recording);
  // See SeriesStore. The curves are read anew where they need it.
  void setProfile(const Profile& profile) {
    store_.setProfile(profile);
    setCurves(std::vector<PlottedCurve>(curves_));
  }
  const OpenedRecordingPtr& recording() const noexcept { return recording_; }
  // Curves that the recording doesn't have stay empty.
  void setCurves(const std::vector<PlottedCurve>& curves);
  const std::vector<PlottedCurve>& curves() const noexcept { return curves_; }
  // Says in the chart what it can't show, a line each; empty: nothing.
  void setNotes(const QStringList& notes);
  UnitAxes& axes() noexcept { return *axes_; }
  SeriesStore& store() noexcept { return store_; }
  // The same recording without filters: its curves are drawn faintly behind. Null, or a long
  // recording: none are drawn.
  void setBefore(const OpenedRecordingPtr& before);
  SeriesStore& storeBefore() noexcept { return before_; }
  // The least space right of the time axis [px].
  void setRight(int px);
  // Moves the cursor; when it leaves a zoomed view, the view moves on by a page.
  void setPosition(double seconds) override;

  void fit();
  // A factor above 1 zooms in, about the cursor if visible; below 1 zooms out. Otherwise the middle
  // of the view is the fixed point.
  void zoom(double factor);
  void zoomAbout(double seconds, double factor) override;
  // Shows the span with a small margin.
  void showSpan(const TimeSpan& span);
  // Limited to the recording.
  void setVisibleRange(double from, double to) override;
  QCPRange seen() const { return xAxis->range(); }
  double durationS() const;

  const std::optional<TimeSpan>& selection() const noexcept { return selection_; }
  // The span is clamped to the recording; nothing: no selection.
  void setSelection(std::optional<TimeSpan> span);

  QString readingAt(const QPointF& at) const override { return valuesAt(secondsAt(at.x())); }
  QSize sizeHint() const override { return {900, 210}; }
  QSize minimumSizeHint() const override { return {240, 90}; }

 signals:
  void selectionChanged();
  // The visible span, or its position in pixels, has changed.
  void seenChanged();
  void menuRequested(const QPoint& globalPosition);
  // No value of the new recording is in the range that was set by hand for this axis: it is
  // automatic again. `name`: that of the axis.
  void rangeDropped(const QString& name, const AxisRange& range);

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void style() override;
  void resized() override;
  void panBy(double seconds) override;

 private:
  enum class Drag { kNone, kPan, kScrub, kSelect, kFrom, kTo };

  void rebuildGraphs();
  void nameTime();
  void refill();
  void shadeUnreadable();
  void scaleAxes();
  // Drops the range that was set by hand for another recording if no value of this one is in it.
  void dropRangeOfOther(const QString& unit, const ValueExtent& shown);
  void placeNotes();
  void placeSelection();
  void showGapLabels();
  Drag dragAt(const QPointF& at) const;
  void dragTo(const QPointF& at);
  QString valuesAt(double seconds) const;

  OpenedRecordingPtr recording_;
  SeriesStore store_;
  // Data of the curves drawn behind.
  SeriesStore before_;
  // Whether curves are drawn behind.
  bool hasBefore_ = false;
  std::vector<PlottedCurve> curves_;
  std::unique_ptr<UnitAxes> axes_;
  // The unit of time where the axis has no title.
  QPointer<QCPItemText> timeUnit_;
  // Units whose range was set by hand for another recording, not yet compared with this one.
  std::set<QString> rangesOfOther_;
  QLabel* notes_;
  QSharedPointer<QCPAxisTicker> secondsTicker_;
  QSharedPointer<QCPAxisTickerTime> clockTicker_;
  std::vector<Gap> gaps_;
  std::size_t numUnreadable_ = 0;  // frames that were shaded as damaged
  // One per gap.
  std::vector<QCPItemText*> gapLabels_;
  // The selection.
  SpanOverlay span_;
  std::optional<TimeSpan> selection_;
  Drag drag_ = Drag::kNone;
  QPointF pressedAt_;
  double pressedS_ = 0.0;
  QCPRange panFrom_;
};

}  // namespace palpate::gui

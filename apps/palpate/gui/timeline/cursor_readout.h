// The readout of two cursors in the timeline, which are the ends of the selection: the time between
// them, and of each curve the first and the last value within the selection with their difference,
// as in the statistics (rangeChange()). An overlay of the chart.
#pragma once

#include <QLabel>
#include <optional>

#include <palpate/model/timing.h>
#include <palpate/signals/range_statistics.h>

#include "gui/chart/plotted_curve.h"

namespace palpate::gui {

class TimelineChart;

class CursorReadout : public QLabel {
  Q_OBJECT
 public:
  explicit CursorReadout(TimelineChart& chart);
  // Whether it is shown while something is selected.
  void setOn(bool on);
  bool on() const noexcept { return on_; }
  // The lines that are shown, for tests: "Δt 1.900 s (0.526 Hz)", "finger 0 distal 120 → 480 Δ 360
  // counts".
  QStringList lines() const { return lines_; }

 private:
  void renew();
  void place();
  // Of a curve, in its shown unit; nothing: no frame in the span has a value.
  std::optional<RangeChange> changeOf(const PlottedCurve& curve, const TimeSpan& span) const;
  // The first `count` of the lines.
  struct Part {
    QString text;
    qsizetype count = 0;
  };
  // As many of the lines as have room [px], `perLine` of them beside each other.
  Part partFor(QSize room, qsizetype perLine) const;

  TimelineChart& chart_;
  bool on_ = false;
  QStringList lines_;
};

}  // namespace palpate::gui

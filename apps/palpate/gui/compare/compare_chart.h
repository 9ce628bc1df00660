// The chart of a comparison: the curves of A (solid) and B (dashed) on one time axis, further
// curves (thin), and their average (thick) with its band. A click or
// drag seeks, the wheel zooms, the middle button (or Shift) pans, a double click shows everything;
// a drag with Ctrl shifts B.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/signals/alignment.h>
#include <palpate/signals/profile_series.h>

#include "gui/appearance/plotted_signal.h"
#include "gui/chart/chart.h"
#include "gui/chart/chart_picture.h"
#include "gui/chart/plotted_curve.h"
#include "gui/compare/compare_overlay.h"

namespace palpate::gui {

// The curves of a comparison; their times refer to the common axis [s].
struct CompareCurves {
  // null: not known yet
  std::shared_ptr<const TimedProfile> a = {}, b = {};
  // Null when not known yet, or when the recording does not have the chosen matrix.
  std::shared_ptr<const Series> curveA = {}, curveB = {};
  double offsetS = 0.0;
  PlottedSignal signal = PlottedSignal::kMean;
  // What is compared instead of the signal: a column of a further series, at its own times.
  std::optional<PlottedCurve> column = {};
  // Unit of A's values.
  QString handUnit = "counts";
  // The units that are shown; the series are in base units.
  DisplayUnits units = {};
  ComparedCurves overlaid = {};
};

class CompareChart : public Chart {
  Q_OBJECT
 public:
  explicit CompareChart(QWidget* parent = nullptr);

  void setCurves(const CompareCurves& curves);
  const CompareCurves& curves() const noexcept { return curves_; }
  // Shifts B. The visible range stays the same while B is dragged; settle() then shows everything
  // again if everything was visible before.
  void setOffset(double offsetS);
  void settle();
  void setPosition(double seconds) override;
  double positionS() const noexcept { return position(); }

  void fit();
  void zoom(double factor) { zoomAbout(xAxis->range().center(), factor); }
  void zoomAbout(double seconds, double factor) override;
  // Limited to what there is.
  void setVisibleRange(double from, double to) override;
  TimeSpan whole() const;
  // A legend for pictures: A and B, the others, and the average.
  std::vector<ChartLegendEntry> legendOf(const QString& nameA, const QString& nameB) const;

  // The least height, as that of CompareView.
  QString readingAt(const QPointF& at) const override { return valuesAt(secondsAt(at.x())); }
  QSize sizeHint() const override { return {900, 90}; }
  QSize minimumSizeHint() const override { return {240, 90}; }

 signals:
  // The mouse shifted B.
  void shifted(double offsetS);
  void shiftEnded();
  // The visible range, or its place on the screen, has changed.
  void rangeChanged();

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void style() override { rebuild(); }
  void resized() override;
  void panBy(double seconds) override;

 private:
  enum class Drag { kNone, kSeek, kPan, kShift };
  void rebuild();
  void addOverlaid();
  void addAverage(const OverlaidAverage& of);
  void fillOverlaid();
  void refill();
  QString valuesAt(double seconds) const;
  ShownUnit shown() const {
    if (curves_.column) return {curves_.column->unit, {.moreDecimals = 2}};
    return shownUnit(curves_.signal, curves_.handUnit, curves_.units);
  }
  QString axisName() const;

  CompareCurves curves_;
  // Of columns, the longest interval between two samples that isn't a gap [s].
  double longestA_ = 0.0;
  double longestB_ = 0.0;
  QCPItemStraightLine* contact_ = nullptr;
  // The graphs of the overlaid curves that are drawn, and of the average: its low and high end, and
  // its middle.
  std::vector<std::pair<std::size_t, QCPGraph*>> overlaidGraphs_;
  std::vector<std::array<QCPGraph*, 3>> averageGraphs_;
  // Everything is visible, and stays so when B moves.
  bool fitted_ = true;
  Drag drag_ = Drag::kNone;
  double dragFromPixel_ = 0.0;
  double dragFromOffsetS_ = 0.0;
  QCPRange dragFromRange_;
};

}  // namespace palpate::gui

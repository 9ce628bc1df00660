// The curves of a comparison on one axis of time: A solid, B dashed. A click or drag seeks, the
// wheel zooms, the middle button (or Shift) pans, a double click shows everything; with Ctrl a drag
// shifts B.
#pragma once

#include <memory>
#include <optional>

#include <palpate/signals/alignment.h>
#include <palpate/signals/profile_series.h>

#include "gui/appearance/plotted_signal.h"
#include "gui/appearance/theme.h"
#include "gui/chart/plot.h"

namespace palpate::gui {

// Times are those of the common axis [s].
struct CompareCurves {
  std::shared_ptr<const TimedProfile> a, b;      // null: not known yet
  std::shared_ptr<const Series> curveA, curveB;  // null: not known yet, or it hasn't that matrix
  double offsetS = 0.0;
  PlottedSignal signal = PlottedSignal::kMean;
};

class CompareChart : public QCustomPlot {
  Q_OBJECT
 public:
  explicit CompareChart(QWidget* parent = nullptr);

  void setCurves(const CompareCurves& curves);
  const CompareCurves& curves() const noexcept { return curves_; }
  // What is seen stays, while B is being dragged; settle() shows everything again, where everything
  // was seen.
  void setOffset(double offsetS);
  void settle();
  void setTheme(Theme theme);
  void setPosition(double seconds);
  double positionS() const noexcept { return positionS_; }

  void fit();
  void zoom(double factor) { zoomAbout(xAxis->range().center(), factor); }
  void zoomAbout(double seconds, double factor);
  double secondsAt(double pixel) const { return xAxis->pixelToCoord(pixel); }
  double pixelOf(double seconds) const { return xAxis->coordToPixel(seconds); }
  int cursorPixel() const { return cursor_->x() + cursor_->width() / 2; }
  TimeSpan whole() const;

  QSize sizeHint() const override { return {900, 190}; }
  QSize minimumSizeHint() const override { return {240, 90}; }

 signals:
  void seekRequested(double seconds);
  void shifted(double offsetS);  // by the mouse
  void shiftEnded();
  void rangeChanged();  // what is seen, or where it lies on screen

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

 private:
  enum class Drag { kNone, kSeek, kPan, kShift };
  void rebuild();
  void refill();
  void setVisibleRange(double from, double to);
  void placeCursor();
  QString valuesAt(double seconds) const;

  CompareCurves curves_;
  Theme theme_ = Theme::kDark;
  QWidget* cursor_;
  QCPItemStraightLine* contact_ = nullptr;
  double positionS_ = 0.0;
  bool fitted_ = true;  // everything is seen: stays so when B moves
  Drag drag_ = Drag::kNone;
  double dragFromPixel_ = 0.0;
  double dragFromOffsetS_ = 0.0;
  QCPRange dragFromRange_;
};

}  // namespace palpate::gui

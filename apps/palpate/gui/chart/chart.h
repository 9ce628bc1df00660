// Base of the charts of the window: takes colours and font anew when they change, shows values at
// the mouse in a tool tip, has a cursor that moves without redrawing the curves, and asks to seek
// where the left button is pressed or dragged. Charts below one another share one horizontal axis.
#pragma once

#include <QPointF>
#include <QString>
#include <optional>

#include "gui/chart/plot.h"

namespace palpate::gui {

class Chart : public QCustomPlot {
  Q_OBJECT
 public:
  explicit Chart(QWidget* parent = nullptr);

  // Shows this range of the horizontal axes; an empty range is ignored.
  virtual void setVisibleRange(double from, double to);
  // Places the cursor, on the horizontal axis plus the origin; NaN: nowhere.
  virtual void setPosition(double at);
  double secondsAt(double pixel) const { return xAxis->pixelToCoord(pixel); }
  double pixelOf(double seconds) const { return xAxis->coordToPixel(seconds); }
  int cursorPixel() const { return cursor_->x() + cursor_->width() / 2; }
  // The text of the tool tip at a place in the widget; empty: none.
  virtual QString readingAt(const QPointF& /*at*/) const { return {}; }

 signals:
  void seekRequested(double at);

 protected:
  // What is left of the visible range when a position outside of it brings the next page, as a
  // share.
  static constexpr double kPageRest = 0.1;

  // The chart has a cursor, and the mouse seeks.
  void addCursor(int widthPx = 2);
  QWidget& cursor() const { return *cursor_; }
  // The position that is 0 on the horizontal axis.
  void setOrigin(double origin) { origin_ = origin; }
  double position() const noexcept { return position_; }
  // Adds a chart below, on the same horizontal axis; `share`: its height over that of the first.
  QCPAxisRect* addBelow(double share);

  // Applies theme, font and size, and redraws; to be called by the constructor, too.
  void restyle();
  // What the chart itself has to style.
  virtual void style() = 0;
  // The chart has another size.
  virtual void resized() { restyle(); }
  // What the wheel does: moves the visible range by so much, or makes it `factor` times shorter.
  virtual void panBy(double /*seconds*/) {}
  virtual void zoomAbout(double /*seconds*/, double /*factor*/) {}
  // The visible range after zooming, within these lengths.
  QCPRange zoomed(double about, double factor, double shortest, double longest) const;
  // The next page, if the position is outside of the visible range.
  std::optional<QCPRange> pageWith(double position) const;

  bool event(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  void placeCursor();

  // Null unless there is one.
  QWidget* cursor_ = nullptr;
  QCPAxisRect* below_ = nullptr;
  int cursorPx_ = 2;
  double position_ = 0.0;
  double origin_ = 0.0;
};

}  // namespace palpate::gui

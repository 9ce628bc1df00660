// Two bars above the chart of a comparison: when A and when B were recorded on the common axis,
// with their gaps and first contacts. Dragging B's bar shifts B.
#pragma once

#include <QWidget>

#include "gui/appearance/theme.h"

namespace palpate::gui {

class CompareChart;

class CompareStrip : public QWidget {
  Q_OBJECT
 public:
  // The strip is as wide as the chart and shares its axis; `chart` must outlive this.
  explicit CompareStrip(const CompareChart& chart, QWidget* parent = nullptr);
  // The bar of A or B in the widget [px]; empty while its times are unknown.
  QRectF barRect(bool ofB) const;

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 signals:
  void shifted(double offsetS);
  void shiftEnded();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  void paintBar(QPainter& painter, bool ofB) const;

  const CompareChart& chart_;
  bool dragging_ = false;
  double dragFromPixel_ = 0.0;
  double dragFromOffsetS_ = 0.0;
  double dragSecondsPerPixel_ = 0.0;
};

}  // namespace palpate::gui

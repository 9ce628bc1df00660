// The chart of the dock Slip for one matrix over time: the displacement of its contact since the
// reference (top) and its rotation (bottom). Thresholds are lines, slip is shaded; a cursor like
// that of the timeline.
#pragma once

#include <QString>
#include <memory>
#include <vector>

#include <palpate/slip/slip_series.h>

#include "gui/chart/chart.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

class SlipChart : public Chart {
  Q_OBJECT
 public:
  explicit SlipChart(QWidget* parent = nullptr);

  // Null: shows nothing.
  void setSeries(const SlipSeries* series, std::size_t matrix, const QString& name);
  void paint(QPainter& painter, const PictureLook& look, const QString& title);

  // The number of shaded time spans, for tests.
  std::size_t numShades() const noexcept { return shades_.size(); }
  QString readingAt(const QPointF& at) const override;
  QSize sizeHint() const override { return {440, 240}; }
  QSize minimumSizeHint() const override { return {220, 150}; }

 protected:
  void style() override;

 private:
  void placeLimits();

  QCPAxisRect* turns_;
  QCPGraph* shift_;
  QCPGraph* turn_;
  // Lines of the thresholds: one for the displacement, two (positive and negative) for the
  // rotation.
  std::vector<QCPItemLine*> limits_;
  std::vector<QCPItemRect*> shades_;
  std::size_t matrix_ = 0;
  QString name_;
  SlipSeriesOptions options_;
  double maxTaxels_ = 0.0, minDeg_ = 0.0, maxDeg_ = 0.0;
};

}  // namespace palpate::gui

// A chart of the force over time of one matrix or of the whole hand, with its 95 % band and a
// cursor like that of the timeline. The curve is grey where the calibration is extrapolated.
#pragma once

#include <QString>
#include <memory>

#include <palpate/calibration/force_series.h>

#include "gui/chart/chart.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

class ForceChart : public Chart {
  Q_OBJECT
 public:
  explicit ForceChart(QWidget* parent = nullptr);

  void setSeries(const std::shared_ptr<const ForceSeries>& series);
  // Shows the force of one matrix; the number of matrices as `matrix` means the whole hand.
  void choose(std::size_t matrix, const QString& name);
  // Paints the chart as a picture for export.
  void paint(QPainter& painter, const PictureLook& look, const QString& title);

  QString readingAt(const QPointF& at) const override;
  QSize sizeHint() const override { return {440, 220}; }
  QSize minimumSizeHint() const override { return {220, 120}; }

 protected:
  void style() override;

 private:
  void fill();

  std::shared_ptr<const ForceSeries> series_;
  std::size_t matrix_ = 0;
  QString name_;
};

}  // namespace palpate::gui

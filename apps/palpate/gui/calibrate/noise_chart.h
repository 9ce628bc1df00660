// A chart of the noise of unloaded matrices over their temperature: the fitted line of every
// matrix, and for the chosen matrix its bins and a band of three RMSE above and below the line.
#pragma once

#include <QString>
#include <vector>

#include <palpate/calibration/noise_floor.h>

#include "gui/chart/chart.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

class NoiseChart : public Chart {
  Q_OBJECT
 public:
  explicit NoiseChart(QWidget* parent = nullptr);

  void setFloor(const NoiseFloor& floor, const QStringList& names);
  void choose(std::size_t matrix);
  // Paints the chart as a picture for export.
  void paint(QPainter& painter, const PictureLook& look, const QString& title);

  QSize sizeHint() const override { return {440, 280}; }
  QSize minimumSizeHint() const override { return {220, 150}; }

 protected:
  void style() override;

 private:
  NoiseFloor floor_;
  QStringList names_;
  std::size_t chosen_ = 0;
};

}  // namespace palpate::gui

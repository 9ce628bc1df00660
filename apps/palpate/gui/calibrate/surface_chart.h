// A chart of the pressure surface P(K, T) from above: gain on the horizontal axis, temperature on
// the vertical axis, pressure as colour. It shows the samples of the fit and the outline of the
// measured region, outside which the colours fade.
#pragma once

#include <optional>
#include <vector>

#include <palpate/calibration/pressure_model.h>

#include "gui/chart/chart.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

class SurfaceChart : public Chart {
  Q_OBJECT
 public:
  explicit SurfaceChart(QWidget* parent = nullptr);

  void setModel(const PressureModel& model, const std::vector<PressureSample>& samples);
  // Draws that sample larger.
  void choose(std::optional<std::size_t> sample);
  // Paints the chart as a picture for export.
  void paint(QPainter& painter, const PictureLook& look, const QString& title);

  // "K 512 counts, 31.2 °C: 48.3 ± 4.1 kPa"; empty outside the axes.
  QString readingAt(const QPointF& at) const override;
  QSize sizeHint() const override { return {440, 280}; }
  QSize minimumSizeHint() const override { return {220, 150}; }

 protected:
  void style() override;
  void resized() override {}

 private:
  void addPoints();

  PressureModel model_;
  std::vector<PressureSample> samples_;
  std::optional<std::size_t> chosen_;
  QCPColorScale* scale_;
};

}  // namespace palpate::gui

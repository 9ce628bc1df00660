// The pressure surface P(K, T) seen from above: gain to the right, temperature upwards, pressure as
// colour; the samples it was made from, and the outline of what was measured, beyond which it
// fades.
#pragma once

#include <optional>
#include <vector>

#include <palpate/calibration/pressure_model.h>

#include "gui/appearance/theme.h"
#include "gui/chart/plot.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

class SurfaceChart : public QCustomPlot {
  Q_OBJECT
 public:
  explicit SurfaceChart(QWidget* parent = nullptr);

  void setModel(const PressureModel& model, const std::vector<PressureSample>& samples);
  void choose(std::optional<std::size_t> sample);  // drawn larger
  void setTheme(Theme theme);
  // What the mouse is told at a place: "K 512 counts, 31.2 °C: 48.3 ± 4.1 kPa"; empty beside the
  // axes.
  QString valueAt(const QPointF& at) const;
  // As a picture of its own.
  void paint(QPainter& painter, const PictureLook& look, const QString& title);

  QSize sizeHint() const override { return {440, 280}; }
  QSize minimumSizeHint() const override { return {220, 150}; }

 protected:
  bool event(QEvent* event) override;

 private:
  void fill();
  void addPoints();

  PressureModel model_;
  std::vector<PressureSample> samples_;
  std::optional<std::size_t> chosen_;
  Theme theme_ = Theme::kDark;
  QCPColorScale* scale_;
};

}  // namespace palpate::gui

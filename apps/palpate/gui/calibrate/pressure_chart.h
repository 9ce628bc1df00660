// A chart of slices through the pressure surface P(K, T): pressure over gain at up to three
// temperatures, with the 95 % prediction band of one new measurement around the middle slice, and
// the samples of the fit. Lines are dashed where the surface is extrapolated.
#pragma once

#include <QString>
#include <optional>

#include <palpate/calibration/pressure_model.h>

#include "gui/chart/chart.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

// The temperature of a sample that the model uses; where none was measured, the assumed one.
double temperatureOf(const PressureSample& sample, const PressureModelOptions& options);
// Lowest, middle and highest temperature of the used samples [deg C]; fewer when they are equal.
std::vector<double> sliceTemperatures(const PressureModel& model,
                                      const std::vector<PressureSample>& samples);

class PressureChart : public Chart {
  Q_OBJECT
 public:
  explicit PressureChart(QWidget* parent = nullptr);

  void setModel(const PressureModel& model, const std::vector<PressureSample>& samples);
  // Draws that sample larger.
  void choose(std::optional<std::size_t> sample);
  // Paints the chart as a picture for export.
  void paint(QPainter& painter, const PictureLook& look, const QString& title);

  QSize sizeHint() const override { return {440, 280}; }
  QSize minimumSizeHint() const override { return {220, 150}; }

 protected:
  void style() override;

 private:
  void addSlice(double degC, const QColor& color, double fromK, double toK, bool band);

  PressureModel model_;
  std::vector<PressureSample> samples_;
  std::optional<std::size_t> chosen_;
};

}  // namespace palpate::gui

// The pressure surface P(K, T) in slices: pressure over gain at three temperatures, with the 95 %
// band of one new measurement about the middle one, and the samples it was made from. Dashed where
// it is beyond what was measured.
#pragma once

#include <QString>
#include <optional>

#include <palpate/calibration/pressure_model.h>

#include "gui/appearance/theme.h"
#include "gui/chart/plot.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

// As the model takes it; where there is none, what is assumed.
double temperatureOf(const PressureSample& sample, const PressureModelOptions& options);
// Coldest, middle and warmest of the used samples [deg C]; fewer where they are the same.
std::vector<double> sliceTemperatures(const PressureModel& model,
                                      const std::vector<PressureSample>& samples);

class PressureChart : public QCustomPlot {
  Q_OBJECT
 public:
  explicit PressureChart(QWidget* parent = nullptr);

  void setModel(const PressureModel& model, const std::vector<PressureSample>& samples);
  void choose(std::optional<std::size_t> sample);  // drawn larger
  void setTheme(Theme theme);
  // As a picture of its own.
  void paint(QPainter& painter, const PictureLook& look, const QString& title);

  QSize sizeHint() const override { return {440, 280}; }
  QSize minimumSizeHint() const override { return {220, 150}; }

 protected:
  bool event(QEvent* event) override;

 private:
  void fill();
  void addSlice(double degC, const QColor& color, double fromK, double toK, bool band);

  PressureModel model_;
  std::vector<PressureSample> samples_;
  std::optional<std::size_t> chosen_;
  Theme theme_ = Theme::kDark;
};

}  // namespace palpate::gui

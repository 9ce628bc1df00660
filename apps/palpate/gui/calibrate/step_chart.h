// A chart of one loading step: its signal with the fitted response, the tangent at its inflection,
// gain and dead time; below it the residuals on the same time axis.
#pragma once

#include <QString>

#include <palpate/calibration/step_report.h>

#include "gui/appearance/plotted_signal.h"
#include "gui/chart/chart.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

class StepChart : public Chart {
  Q_OBJECT
 public:
  explicit StepChart(QWidget* parent = nullptr);

  // Shows a step. The times of `samples` are seconds since the begin of the step, which is at
  // `beginS` [s] of the recording.
  void setStep(const FittedStep& step,
               const StepSignal& samples,
               double beginS,
               std::size_t matrix,
               PlottedSignal signal);
  // Paints the chart as a picture for export.
  void paint(QPainter& painter, const PictureLook& look, const QString& title, const QString& name);

  QString readingAt(const QPointF& at) const override;
  QSize sizeHint() const override { return {440, 300}; }
  QSize minimumSizeHint() const override { return {220, 170}; }

 protected:
  void style() override;
  void resized() override { nameAxes(); }

 private:
  enum Graph { kData, kFit, kTangent, kInflection, kResidual };
  void fill(const StepSignal& samples);
  void nameAxes();

  FittedStep step_;
  std::size_t matrix_ = 0;
  PlottedSignal signal_ = PlottedSignal::kFilteredMean;
  // Axes of the residuals.
  QCPAxis* time_;
  QCPAxis* residual_;
  QCPItemLine* gain_;
  QCPItemText* gainName_;
};

}  // namespace palpate::gui

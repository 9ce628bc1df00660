// A chart of one loading step: its signal with the fitted response, the tangent at its inflection,
// gain and dead time; below it the residuals on the same time axis.
#pragma once

#include <QString>

#include <palpate/calibration/step_report.h>

#include "gui/appearance/plotted_signal.h"
#include "gui/appearance/theme.h"
#include "gui/chart/plot.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

class StepChart : public QCustomPlot {
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
  void setTheme(Theme theme);
  // [s] in the recording
  void setPosition(double seconds);
  QString valuesAt(const QPointF& at) const;
  // Paints the chart as a picture for export.
  void paint(QPainter& painter, const PictureLook& look, const QString& title, const QString& name);

  QSize sizeHint() const override { return {440, 300}; }
  QSize minimumSizeHint() const override { return {220, 170}; }

 signals:
  // [s] in the recording
  void seekRequested(double seconds);

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

 private:
  enum Graph { kData, kFit, kTangent, kInflection, kResidual };
  void fill(const StepSignal& samples);
  void style();
  void nameAxes();
  void placeCursor();

  FittedStep step_;
  double beginS_ = 0.0;
  std::size_t matrix_ = 0;
  PlottedSignal signal_ = PlottedSignal::kFilteredMean;
  Theme theme_ = Theme::kDark;
  QCPAxisRect* below_;
  // Axes of the residuals.
  QCPAxis* time_;
  QCPAxis* residual_;
  QCPItemLine* gain_;
  QCPItemText* gainName_;
  QWidget* cursor_;
  double positionS_ = 0.0;
};

}  // namespace palpate::gui

#include "gui/calibrate/step_chart.h"

#include <QMouseEvent>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "gui/appearance/captions.h"
#include "gui/chart/chart_picture.h"
#include "gui/chart/chart_style.h"

namespace palpate::gui {
namespace {

constexpr double kStepChartHeadroom = 1.12;
// Height of the residuals relative to the data.
constexpr double kResidualShare = 0.42;
constexpr int kFitPoints = 600;
constexpr double kDotSize = 3.0;  // [px]

QPen dashed(const QColor& color) { return {color, 1.2, Qt::DashLine}; }

}  // namespace

StepChart::StepChart(QWidget* parent) : Chart(parent) {
  setObjectName("stepChart");
  setAccessibleName("Step response with its fit, residuals below");
  axisRect()->setMinimumMargins(QMargins(52, 8, 12, 4));
  QCPAxisRect* below = addBelow(kResidualShare);
  time_ = below->axis(QCPAxis::atBottom);
  residual_ = below->axis(QCPAxis::atLeft);
  below->setMinimumMargins(QMargins(52, 6, 12, 10));
  for (const char* name : {"signal", "fit", "tangent", "inflection"}) addGraph()->setName(name);
  addGraph(time_, residual_)->setName("residual");
  graph(kData)->setLineStyle(QCPGraph::lsNone);
  graph(kInflection)->setLineStyle(QCPGraph::lsNone);
  gain_ = new QCPItemLine(this);
  gainName_ = new QCPItemText(this);
  gainName_->setPositionAlignment(Qt::AlignRight | Qt::AlignBottom);
  gainName_->setPadding(QMargins(0, 0, 4, 1));
  legend->setVisible(true);
  // No legend for the residuals: their axis has a title.
  legend->removeItem(legend->itemCount() - 1);
  axisRect()->insetLayout()->setInsetAlignment(0, Qt::AlignBottom | Qt::AlignRight);
  addCursor();
  restyle();
}

void StepChart::setStep(const FittedStep& step,
                        const StepSignal& samples,
                        double beginS,
                        std::size_t matrix,
                        PlottedSignal signal) {
  step_ = step;
  setOrigin(beginS);
  matrix_ = matrix;
  signal_ = signal;
  fill(samples);
  restyle();
}

void StepChart::fill(const StepSignal& samples) {
  const StepParameters& fitted = step_.fit.parameters;
  QVector<QCPGraphData> measured, fit, residuals;
  const double endS = samples.timeS.empty() ? 1.0 : std::max(samples.timeS.back(), 1e-3);
  double high = 0.0, most = 0.0;
  for (std::size_t i = 0; i < samples.timeS.size(); ++i) {
    const double t = samples.timeS[i], value = samples.values[i];
    measured.append({t, value});
    high = std::max(high, value);
    if (!step_.fit.converged || !std::isfinite(value)) continue;
    const double residual = value - stepResponse(fitted, t);
    residuals.append({t, residual});
    most = std::max(most, std::abs(residual));
  }
  QVector<QCPGraphData> tangent, inflection;
  const StepCharacteristics& shape = step_.characteristics;
  if (step_.fit.converged) {
    for (int i = 0; i <= kFitPoints; ++i) {
      // The points are closer together at the begin, where the curve bends.
      const double share = static_cast<double>(i) / kFitPoints;
      const double t = endS * share * share;
      fit.append({t, stepResponse(fitted, t)});
    }
    high = std::max(high, fitted.staticResponseCounts);
    if (std::isfinite(shape.inflectionS) && std::isfinite(shape.tangentAtGainS)) {
      tangent.append({std::max(0.0, shape.deadTimeS), 0.0});
      tangent.append({shape.tangentAtGainS, fitted.staticResponseCounts});
      inflection.append({shape.inflectionS, shape.inflectionCounts});
    }
  }
  graph(kData)->data()->set(measured, true);
  graph(kFit)->data()->set(fit, true);
  graph(kTangent)->data()->set(tangent, true);
  graph(kInflection)->data()->set(inflection, true);
  graph(kResidual)->data()->set(residuals, true);
  for (QCPAxis* axis : {xAxis, time_}) axis->setRange(0.0, endS);
  yAxis->setRange(0.0, (high > 0.0 ? high : 1.0) * kStepChartHeadroom);
  const double reach = most > 0.0 ? most * kStepChartHeadroom : 1.0;
  residual_->setRange(-reach, reach);
  gain_->start->setCoords(0.0, fitted.staticResponseCounts);
  gain_->end->setCoords(endS, fitted.staticResponseCounts);
  gainName_->position->setCoords(endS, fitted.staticResponseCounts);
  gainName_->setText("K");
  gain_->setVisible(step_.fit.converged);
  gainName_->setVisible(step_.fit.converged);
}

void StepChart::style() {
  const ThemeColors& colors = colorsOf();
  residual_->grid()->setVisible(true);
  residual_->ticker()->setTickCount(2);
  time_->ticker()->setTickCount(8);
  yAxis->ticker()->setTickCount(5);
  const QColor curve = matrixColor(matrix_);
  graph(kData)->setPen(QPen(curve, 1.0));
  graph(kData)->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssDisc, curve, curve, kDotSize));
  graph(kFit)->setPen(QPen(colors.text, 1.4));
  graph(kTangent)->setPen(dashed(colors.muted));
  graph(kInflection)->setPen(QPen(colors.warning, 1.4));
  graph(kInflection)
      ->setScatterStyle(
          QCPScatterStyle(QCPScatterStyle::ssDiamond, QPen(colors.warning, 1.4), Qt::NoBrush, 8));
  graph(kResidual)->setPen(QPen(curve, 1.0));
  gain_->setPen(QPen(colors.muted, 1.0, Qt::DotLine));
  gainName_->setColor(colors.muted);
  gainName_->setFont(font());
  nameAxes();
}

void StepChart::nameAxes() {
  const QString unit = unitOf(signal_, "counts");
  yAxis->setLabel(fittingName(nameOf(signal_) + " in " + unit, unit, *this));
  residual_->setLabel(height() < 260 ? QString() : "residual");
  time_->setLabel("time from the start of the step in s");
}

QString StepChart::readingAt(const QPointF& at) const {
  const double seconds = secondsAt(at.x());
  auto found = graph(kData)->data()->findEnd(seconds, false);
  if (found == graph(kData)->data()->constBegin()) return {};
  --found;
  QString text = figure(found->key, 3) + " s\n" + nameOf(signal_) + " " + figure(found->value, 1) +
                 " " + unitOf(signal_, "counts");
  if (step_.fit.converged) {
    const double fitted = stepResponse(step_.fit.parameters, found->key);
    text += "\nfit " + figure(fitted, 1) + ", residual " + figure(found->value - fitted, 2);
  }
  return text;
}

void StepChart::paint(QPainter& painter,
                      const PictureLook& look,
                      const QString& title,
                      const QString& name) {
  // The exported picture has its own legend.
  legend->setVisible(false);
  paintChart(painter, look, *this, {.title = title, .caption = name});
  legend->setVisible(true);
}

}  // namespace palpate::gui

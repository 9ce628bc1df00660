#include "gui/slip/slip_chart.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QToolTip>
#include <algorithm>
#include <cmath>
#include <limits>

#include "gui/appearance/captions.h"
#include "gui/chart/chart_picture.h"
#include "gui/chart/chart_style.h"

namespace palpate::gui {
namespace {

constexpr double kSlipChartHeadroom = 1.15;
constexpr double kTurnShare = 0.75;  // height relative to the chart above
// Most points that are drawn; with more, the largest of each group.
constexpr std::size_t kSlipChartMostPoints = 20'000;
constexpr double kSlipChartNothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

SlipChart::SlipChart(QWidget* parent) : QCustomPlot(parent) {
  setObjectName("slipChart");
  setAccessibleName("Motion since the reference, and rotation, over time");
  arrangeChart(*this);
  setMouseTracking(true);
  shift_ = addGraph();
  turns_ = new QCPAxisRect(this);
  plotLayout()->addElement(1, 0, turns_);
  plotLayout()->setRowSpacing(0);
  plotLayout()->setRowStretchFactor(1, kTurnShare);
  auto* sides = new QCPMarginGroup(this);
  for (QCPAxisRect* each : {axisRect(), turns_})
    each->setMarginGroup(QCP::msLeft | QCP::msRight, sides);
  axisRect()->setMinimumMargins(QMargins(52, 10, 20, 4));
  turns_->setMinimumMargins(QMargins(52, 4, 20, 10));
  xAxis->setTickLabels(false);
  QCPAxis* time = turns_->axis(QCPAxis::atBottom);
  QCPAxis* degrees = turns_->axis(QCPAxis::atLeft);
  for (QCPAxis* axis : {time, degrees}) {
    axis->setNumberFormat("gb");
    axis->setTickLengthIn(0);
    axis->setTickLengthOut(4);
    axis->setLayer("axes");
    axis->grid()->setLayer("grid");
  }
  time->grid()->setVisible(false);
  time->ticker()->setTickCount(9);
  degrees->ticker()->setTickCount(4);
  time->setLabel("time from the first frame in s");
  turn_ = addGraph(time, degrees);
  for (int i = 0; i < 3; ++i) {
    auto* line = new QCPItemLine(this);
    QCPAxisRect* rect = i == 0 ? axisRect() : turns_;
    for (QCPItemPosition* end : {line->start, line->end}) {
      end->setAxisRect(rect);
      end->setAxes(rect->axis(QCPAxis::atBottom), rect->axis(QCPAxis::atLeft));
      end->setTypeX(QCPItemPosition::ptAxisRectRatio);
      end->setTypeY(QCPItemPosition::ptPlotCoords);
    }
    line->setClipAxisRect(rect);
    limits_.push_back(line);
  }
  cursor_ = new QWidget(this);
  cursor_->setAttribute(Qt::WA_TransparentForMouseEvents);
  connect(this, &QCustomPlot::afterReplot, this, &SlipChart::placeCursor);
  style();
}

void SlipChart::setSeries(const SlipSeries* series, std::size_t matrix, const QString& name) {
  matrix_ = matrix;
  name_ = name;
  for (QCPItemRect* shade : shades_) removeItem(shade);
  shades_.clear();
  QVector<QCPGraphData> shift, turn;
  maxTaxels_ = minDeg_ = maxDeg_ = 0.0;
  if (series && matrix < series->matrices.size()) {
    options_ = series->options;
    const std::vector<SlipSample>& samples = series->matrices[matrix];
    const std::size_t bunch = samples.size() / kSlipChartMostPoints + 1;
    for (std::size_t first = 0; first < samples.size(); first += bunch) {
      std::size_t at = first;
      for (std::size_t i = first; i < std::min(first + bunch, samples.size()); ++i)
        if (samples[i].refValid && samples[i].shiftTaxels() > samples[at].shiftTaxels()) at = i;
      const SlipSample& sample = samples[at];
      const double t = series->timeS[sample.frame];
      // A lost contact is a gap in the curve.
      if (first > 0 && sample.frame > samples[first - 1].frame + bunch) {
        shift.append({t, kSlipChartNothing});
        turn.append({t, kSlipChartNothing});
      }
      shift.append({t, sample.refValid ? sample.shiftTaxels() : kSlipChartNothing});
      const double deg = static_cast<double>(sample.refRotationDeg);
      turn.append({t, sample.refRotationValid ? deg : kSlipChartNothing});
      if (sample.refValid) maxTaxels_ = std::max(maxTaxels_, sample.shiftTaxels());
      if (!sample.refRotationValid) continue;
      minDeg_ = std::min(minDeg_, deg);
      maxDeg_ = std::max(maxDeg_, deg);
    }
    for (const SlipSegment& slip : series->slips) {
      if (slip.matrix != matrix) continue;
      QCPItemRect* shade =
          shadeSpan(*this, series->timeS[slip.begin], series->timeS[slip.end], theme_);
      shades_.push_back(shade);
    }
  }
  shift_->data()->set(shift, true);
  turn_->data()->set(turn, true);
  style();
}

void SlipChart::setTheme(Theme theme) {
  theme_ = theme;
  style();
}

void SlipChart::placeLimits() {
  const double values[] = {options_.referenceTaxels, options_.rotationDeg, -options_.rotationDeg};
  for (std::size_t i = 0; i < limits_.size(); ++i) {
    limits_[i]->start->setCoords(0.0, values[i]);
    limits_[i]->end->setCoords(1.0, values[i]);
  }
  yAxis->setRange(0.0, std::max(maxTaxels_, options_.referenceTaxels) * kSlipChartHeadroom);
  turns_->axis(QCPAxis::atLeft)
      ->setRange(std::min(minDeg_, -options_.rotationDeg) * kSlipChartHeadroom,
                 std::max(maxDeg_, options_.rotationDeg) * kSlipChartHeadroom);
}

void SlipChart::style() {
  const ThemeColors& colors = colorsOf(theme_);
  styleChart(*this, theme_);
  QCPAxis* degrees = turns_->axis(QCPAxis::atLeft);
  styleExtraAxis(*turns_->axis(QCPAxis::atBottom), *this, theme_);
  turns_->axis(QCPAxis::atBottom)->ticker()->setTickCount(9);
  styleExtraAxis(*degrees, *this, theme_);
  degrees->grid()->setVisible(true);
  // Each chart has half of the height.
  const bool low = height() < 2 * 190;
  yAxis->setLabel(low ? "taxels" : "since reference in taxels");
  for (QCPAxis* axis : {yAxis, degrees}) axis->ticker()->setTickCount(low ? 2 : 4);
  degrees->setLabel(low ? "deg" : "rotation in deg");
  const QColor color = matrixColor(matrix_, theme_);
  for (QCPGraph* each : {shift_, turn_}) each->setPen(QPen(color, 1.5));
  for (QCPItemLine* line : limits_) line->setPen(QPen(colors.danger, 1.0, Qt::DashLine));
  QColor shade = colors.danger;
  shade.setAlphaF(0.16F);
  for (QCPItemRect* each : shades_) each->setBrush(shade);
  cursor_->setStyleSheet("background: " + colors.accent.name());
  placeLimits();
  replot(QCustomPlot::rpQueuedReplot);
}

void SlipChart::setVisibleRange(double fromS, double toS) {
  if (!(toS > fromS)) return;
  for (QCPAxis* axis : {xAxis, turns_->axis(QCPAxis::atBottom)}) axis->setRange(fromS, toS);
  replot(QCustomPlot::rpQueuedReplot);
}

void SlipChart::setPosition(double seconds) {
  positionS_ = seconds;
  placeCursor();
}

void SlipChart::placeCursor() {
  const QRect plot = axisRect()->rect();
  const int x = static_cast<int>(std::lround(xAxis->coordToPixel(positionS_)));
  const bool inside = x >= plot.left() && x <= plot.right() + 1;
  cursor_->setGeometry(x - 1, plot.top(), 2, turns_->rect().bottom() - plot.top());
  if (cursor_->isHidden() == inside) cursor_->setVisible(inside);
}

void SlipChart::paint(QPainter& painter, const PictureLook& look, const QString& title) {
  paintChart(
      painter,
      look,
      *this,
      {.title = title, .legend = {{name_, shift_->pen()}, {"threshold", limits_.front()->pen()}}});
}

void SlipChart::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton)
    emit seekRequested(xAxis->pixelToCoord(event->position().x()));
}

void SlipChart::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton)
    emit seekRequested(xAxis->pixelToCoord(event->position().x()));
}

bool SlipChart::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const double at = xAxis->pixelToCoord(help->pos().x());
    const auto shift = shift_->data()->findBegin(at);
    const auto turn = turn_->data()->findBegin(at);
    if (shift == shift_->data()->constEnd()) return true;
    QString text = figure(shift->key, 2) + " s";
    if (std::isfinite(shift->value)) text += "\n" + figure(shift->value, 2) + " taxels";
    if (std::isfinite(turn->value)) text += "\n" + figure(turn->value, 1) + "°";
    QToolTip::showText(help->globalPos(), text, this);
    return true;
  }
  if (event->type() == QEvent::FontChange || event->type() == QEvent::Resize) style();
  return QCustomPlot::event(event);
}

}  // namespace palpate::gui

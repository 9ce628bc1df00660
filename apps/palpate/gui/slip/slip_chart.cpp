#include "gui/slip/slip_chart.h"

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

SlipChart::SlipChart(QWidget* parent) : Chart(parent) {
  setObjectName("slipChart");
  setAccessibleName("Motion since the reference, and rotation, over time");
  shift_ = addGraph();
  turns_ = addBelow(kTurnShare);
  axisRect()->setMinimumMargins(QMargins(52, 10, 20, 4));
  turns_->setMinimumMargins(QMargins(52, 4, 20, 10));
  QCPAxis* time = turns_->axis(QCPAxis::atBottom);
  QCPAxis* degrees = turns_->axis(QCPAxis::atLeft);
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
  addCursor();
  restyle();
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
      QCPItemRect* shade = shadeSpan(*this, series->timeS[slip.begin], series->timeS[slip.end]);
      shades_.push_back(shade);
    }
  }
  shift_->data()->set(shift, true);
  turn_->data()->set(turn, true);
  restyle();
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
  const ThemeColors& colors = colorsOf();
  QCPAxis* degrees = turns_->axis(QCPAxis::atLeft);
  turns_->axis(QCPAxis::atBottom)->ticker()->setTickCount(9);
  degrees->grid()->setVisible(true);
  // Each chart has half of the height.
  const bool low = height() < 2 * 190;
  yAxis->setLabel(low ? "taxels" : "since reference in taxels");
  for (QCPAxis* axis : {yAxis, degrees}) axis->ticker()->setTickCount(low ? 2 : 4);
  degrees->setLabel(low ? "deg" : "rotation in deg");
  const QColor color = matrixColor(matrix_);
  for (QCPGraph* each : {shift_, turn_}) each->setPen(QPen(color, 1.5));
  for (QCPItemLine* line : limits_) line->setPen(QPen(colors.danger, 1.0, Qt::DashLine));
  QColor shade = colors.danger;
  shade.setAlphaF(0.16F);
  for (QCPItemRect* each : shades_) each->setBrush(shade);
  placeLimits();
}

void SlipChart::paint(QPainter& painter, const PictureLook& look, const QString& title) {
  paintChart(
      painter,
      look,
      *this,
      {.title = title, .legend = {{name_, shift_->pen()}, {"threshold", limits_.front()->pen()}}});
}

QString SlipChart::readingAt(const QPointF& at) const {
  const double seconds = secondsAt(at.x());
  const auto shift = shift_->data()->findBegin(seconds);
  const auto turn = turn_->data()->findBegin(seconds);
  if (shift == shift_->data()->constEnd()) return {};
  QString text = figure(shift->key, 2) + " s";
  if (std::isfinite(shift->value)) text += "\n" + figure(shift->value, 2) + " taxels";
  if (std::isfinite(turn->value)) text += "\n" + figure(turn->value, 1) + "°";
  return text;
}

}  // namespace palpate::gui

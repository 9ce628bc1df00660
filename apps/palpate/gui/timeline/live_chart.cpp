#include "gui/timeline/live_chart.h"

#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <limits>

#include <palpate/core/time.h>

#include "gui/chart/chart_style.h"
#include "gui/picture/stale_notice.h"

namespace palpate::gui {
namespace {

constexpr double kLiveChartHeadroom = 1.06;
// The axis is shortened when the largest value is below this share of it.
constexpr double kShrinkBelow = 0.35;
// Without a frame for so long [s], the chart scrolls by itself.
constexpr double kOldS = 0.4;
constexpr std::size_t kMostEvents = 200;
// Least time that the chart moves on when it is drawn [s]: every second frame of an SDH-2, 2 pixels
// of a chart of 30 s on a usual screen.
constexpr double kLeastStepS = 0.05;

// The least 1, 2 or 5 times a power of ten at or above `value`, so that the axis changes only in
// steps.
double niceAbove(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-9))));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= value) return factor * power;
  return 10.0 * power;
}

QString nameOfEvent(const RecordingEvent& event) {
  const QString text = QString::fromStdString(event.text);
  if (event.kind == "mark") return "mark";
  if (event.kind == "label") return text;
  if (event.kind == "gap") return "gap";
  if (event.kind == "grasp") return text.section(':', 0, 0);  // "opening", "reactive grasp refused"
  return QString::fromStdString(event.kind);
}

}  // namespace

LiveChart::LiveChart(QWidget* parent)
    : QCustomPlot(parent), secondsTicker_(new QCPAxisTickerFixed) {
  arrangeChart(*this);
  setAccessibleName("Live chart");
  setToolTip("Wheel: how many seconds are shown");
  xAxis->setLabel("time since the first frame in s");
  xAxis->setTicker(secondsTicker_);
  roll(0.0);
}

double LiveChart::secondsOf(std::int64_t hostUs) const {
  return static_cast<double>(hostUs - originUs_.value_or(hostUs)) / kUsPerS;
}

void LiveChart::setHistory(const SignalHistory* history,
                           std::size_t numMatrices,
                           const QString& handUnit) {
  history_ = history;
  handUnit_ = handUnit;
  originUs_.reset();
  newestUs_ = 0;
  nowS_ = 0.0;
  setHeld(false);
  largest_ = 0.0;
  plotted_.assign(history ? numMatrices + 1 : 0, true);
  if (!plotted_.empty()) plotted_.back() = false;
  forget(std::numeric_limits<double>::infinity());
  rebuild();
}

void LiveChart::setSignal(PlottedSignal signal) {
  if (signal == signal_) return;
  signal_ = signal;
  rebuild();
}

void LiveChart::setPlotted(const std::vector<bool>& plotted) {
  if (plotted == plotted_) return;
  plotted_ = plotted;
  rebuild();
}

void LiveChart::setTheme(Theme theme) {
  theme_ = theme;
  styleChart(*this, theme);
  for (const Shown& event : events_)
    event.name->setColor(event.isGap ? colorsOf(theme).warning : colorsOf(theme).text);
  rebuild();
}

void LiveChart::setWindowS(double seconds) {
  const double wanted = std::clamp(seconds, kShortestS, kMaxWindowS);
  if (wanted == windowS_) return;
  windowS_ = wanted;
  roll(nowS_);
  emit windowChanged(windowS_);
}

void LiveChart::setHeld(bool held) {
  held_ = held;
  update();
}

void LiveChart::paintEvent(QPaintEvent* event) {
  QCustomPlot::paintEvent(event);
  if (!held_) return;
  QPainter painter(this);
  paintStaleNotice(painter, rect(), {kHeldText, true}, theme_);
}

void LiveChart::rebuild() {
  clearGraphs();
  rows_.clear();
  nameAxis();
  for (std::size_t row = 0; row < plotted_.size(); ++row) {
    if (!plotted_[row]) continue;
    const bool whole = row + 1 == plotted_.size();
    QCPGraph* graph = addGraph();
    graph->setPen(curvePen(row, whole, theme_));
    rows_.push_back(row);
  }
  largest_ = 0.0;
  newestUs_ = 0;
  if (history_) append(history_->after(std::numeric_limits<std::int64_t>::min()), false);
  roll(nowS_);
}

void LiveChart::append(const std::vector<SignalSample>& samples, bool areNew) {
  for (const SignalSample& sample : samples) {
    if (!originUs_) originUs_ = sample.hostUs;
    const double atS = secondsOf(sample.hostUs);
    for (std::size_t g = 0; g < rows_.size(); ++g) {
      auto& series = *graph(static_cast<int>(g))->data();
      if (sample.afterGap && series.size() > 0)
        series.add(QCPGraphData((series.constEnd() - 1)->key + 1e-6,
                                std::numeric_limits<double>::quiet_NaN()));
      if (rows_[g] < sample.rows.size())
        series.add(QCPGraphData(atS, valueOf(sample.rows[rows_[g]], signal_)));
    }
    if (sample.afterGap && areNew && newestUs_ != 0) shadeGap(secondsOf(newestUs_), atS);
    newestUs_ = sample.hostUs;
  }
}

void LiveChart::refresh(double silentS) {
  if (!history_ || held_) return;
  const auto samples = history_->after(newestUs_);
  append(samples, true);
  if (samples.empty() && (silentS < kOldS || !originUs_)) return;
  const double newestS = originUs_ ? secondsOf(newestUs_) : 0.0;
  const double nowS = samples.empty() ? newestS + silentS : newestS;
  // A step of less than this is not seen, but drawing takes as long as for a large one. What
  // arrived is drawn by the next step, or when nothing comes any more.
  if (nowS >= nowS_ && nowS - nowS_ < kLeastStepS && graphCount() > 0 && graph(0)->dataCount() > 2)
    return;
  forget(nowS - kMaxWindowS);
  roll(nowS);
}

void LiveChart::roll(double nowS) {
  nowS_ = nowS;
  const double toS = std::max(nowS, windowS_);
  xAxis->setRange(toS - windowS_, toS);
  constexpr double kMostTicks = 12.0, kTickRoom = 60.0;  // [px]
  const double ticks = std::clamp(axisRect()->width() / kTickRoom, 2.0, kMostTicks);
  secondsTicker_->setTickStep(niceAbove(windowS_ / ticks));
  arrangeNames();
  fitHeight(toS - windowS_);
  replot(QCustomPlot::rpQueuedReplot);
}

void LiveChart::fitHeight(double fromS) {
  double largest = 0.0;
  for (int g = 0; g < graphCount(); ++g) {
    const auto series = graph(g)->data();
    for (auto at = series->findBegin(fromS, false); at != series->constEnd(); ++at)
      // False for the NaN of a gap.
      if (at->value > largest) largest = at->value;
  }
  if (largest > largest_ || largest < kShrinkBelow * largest_)
    largest_ = largest > 0.0 ? niceAbove(largest * kLiveChartHeadroom) : 0.0;
  yAxis->setRange(0.0, largest_ > 0.0 ? largest_ : 1.0);
}

void LiveChart::forget(double beforeS) {
  for (int g = 0; g < graphCount(); ++g) graph(g)->data()->removeBefore(beforeS);
  while (!events_.empty() && (events_.front().endS < beforeS || events_.size() > kMostEvents)) {
    if (events_.front().shape) removeItem(events_.front().shape);
    if (events_.front().name) removeItem(events_.front().name);
    events_.pop_front();
  }
}

void LiveChart::addEvent(const RecordingEvent& event) {
  if (!history_) return;
  const ThemeColors& colors = colorsOf(theme_);
  const double beginS = secondsOf(event.tUs);
  // Gaps are visible in the samples.
  if (event.kind == "gap") return;
  if (event.kind == "mark" || event.kind == "label")
    line(beginS, nameOfEvent(event), colors.accent);
  else if (event.kind == "grasp")
    line(event.t1Us > event.tUs ? secondsOf(event.t1Us) : beginS, nameOfEvent(event), colors.muted);
}

void LiveChart::line(double atS, const QString& name, const QColor& color) {
  auto* shape = new QCPItemLine(this);
  for (QCPItemPosition* end : {shape->start, shape->end}) {
    end->setTypeX(QCPItemPosition::ptPlotCoords);
    end->setTypeY(QCPItemPosition::ptAxisRectRatio);
  }
  shape->start->setCoords(atS, 0.0);
  shape->end->setCoords(atS, 1.0);
  shape->setPen(QPen(color, 1.0));
  auto* text = wordAt(*this, atS, name, Qt::AlignLeft, colorsOf(theme_).text);
  events_.push_back({atS, atS, false, shape, text});
  arrangedFor_ = 0.0;
}

// Places names of neighbouring events one below the other, so that none covers another one; a name
// for which no line is free is hidden.
void LiveChart::arrangeNames() {
  const double pxPerS = axisRect()->width() / windowS_;
  const double key = pxPerS + 1e6 * axisRect()->height();
  if (key == arrangedFor_) return;
  arrangedFor_ = key;
  const int lineHeight = fontMetrics().lineSpacing();
  constexpr int kMostLines = 4, kBetween = 10;  // [px]
  const int lines = std::clamp(axisRect()->height() / (2 * lineHeight), 1, kMostLines);
  std::vector<double> usedTo(static_cast<std::size_t>(lines), -1e12);  // [px]
  for (const Shown& event : events_) {
    const double width = fontMetrics().horizontalAdvance(event.name->text());
    const double left =
        event.isGap ? (event.beginS + event.endS) / 2 * pxPerS - width / 2 : event.beginS * pxPerS;
    const auto free =
        std::find_if(usedTo.begin(), usedTo.end(), [&](double to) { return to <= left; });
    event.name->setVisible(free != usedTo.end());
    if (free == usedTo.end()) continue;
    *free = left + width + kBetween;
    event.name->setPadding(
        QMargins(event.isGap ? 0 : 4, static_cast<int>(free - usedTo.begin()) * lineHeight, 0, 0));
  }
}

void LiveChart::shadeGap(double beginS, double endS) {
  auto* shape = shadeSpan(*this, beginS, endS, theme_);
  auto* text = wordAt(*this,
                      (beginS + endS) / 2,
                      "gap " + QString::number(endS - beginS, 'f', 1) + " s",
                      Qt::AlignHCenter,
                      colorsOf(theme_).warning);
  events_.push_back({beginS, endS, true, shape, text});
  arrangedFor_ = 0.0;
}

void LiveChart::nameAxis() { yAxis->setLabel(signalAxisName(signal_, handUnit_, *this)); }

void LiveChart::wheelEvent(QWheelEvent* event) {
  setWindowS(windowS_ / std::pow(kWheelZoom, event->angleDelta().y() / kWheelNotch));
  event->accept();
}

void LiveChart::resizeEvent(QResizeEvent* event) {
  QCustomPlot::resizeEvent(event);
  nameAxis();
  replot(QCustomPlot::rpQueuedReplot);
}

void LiveChart::changeEvent(QEvent* event) {
  if (event->type() == QEvent::FontChange) setTheme(theme_);
  QCustomPlot::changeEvent(event);
}

}  // namespace palpate::gui

#include "gui/timeline_chart.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include <palpate/filter/min_max_decimation.h>

#include "gui/chart_style.h"

namespace palpate::gui {
namespace {

constexpr double kEmptyDurationS = 1.0;  // axis of a recording without extent
constexpr double kShortestSeenS = 0.05;
constexpr double kHeadroom = 1.06;   // the highest curve stays below the frame
constexpr double kWheelStep = 1.25;  // zoom per notch
constexpr double kNotch = 120.0;     // angleDelta of one notch
constexpr int kCursorWidth = 2;      // [px]
constexpr double kPageRest = 0.1;    // part of the old page that a new page starts with
constexpr std::size_t kMostGapMarks = 2000;

}  // namespace

TimelineChart::TimelineChart(QWidget* parent) : QCustomPlot(parent) {
  arrangeChart(*this);
  setAccessibleName("Timeline");
  setMouseTracking(true);
  xAxis->setLabel("time from the first frame in s");
  cursor_ = new QWidget(this);
  cursor_->setAttribute(Qt::WA_TransparentForMouseEvents);
  cursor_->setAutoFillBackground(true);
  cursor_->hide();
  // Margins are known only once the axes have been laid out.
  connect(this, &QCustomPlot::afterReplot, this, &TimelineChart::placeCursor);
}

double TimelineChart::durationS() const {
  if (!recording_ || recording_->timeS.empty()) return kEmptyDurationS;
  return std::max(recording_->timeS.back(), kShortestSeenS);
}

void TimelineChart::setRecording(const OpenedRecordingPtr& recording) {
  recording_ = recording;
  positionS_ = 0.0;
  plotted_.clear();
  cursor_->setVisible(recording_ != nullptr);
  rebuildGraphs();
  fit();
}

void TimelineChart::setSignal(PlottedSignal signal) {
  signal_ = signal;
  rebuildGraphs();
}

void TimelineChart::setPlotted(const std::vector<bool>& plotted) {
  if (plotted == plotted_) return;
  plotted_ = plotted;
  rebuildGraphs();
}

void TimelineChart::setTheme(Theme theme) {
  theme_ = theme;
  const ThemeColors& colors = colorsOf(theme);
  styleChart(*this, theme);
  QPalette palette;
  palette.setColor(QPalette::Window, colors.accent);
  cursor_->setPalette(palette);
  cursor_->setStyleSheet("background: " + colors.accent.name());
  rebuildGraphs();
}

void TimelineChart::rebuildGraphs() {
  clearGraphs();
  clearItems();
  graphRows_.clear();
  graphValues_.clear();
  gapLabels_.clear();
  nameAxis();
  double largest = 0.0;
  const std::size_t frames = recording_ ? recording_->profile.numFrames() : 0;
  for (std::size_t row = 0; row < plotted_.size() && frames > 0; ++row) {
    if (!plotted_[row]) continue;
    std::vector<double> values(frames);
    for (std::size_t i = 0; i < frames; ++i) values[i] = valueOf(recording_->at(i, row), signal_);
    largest = std::max(largest, *std::max_element(values.begin(), values.end()));
    const bool whole = row + 1 == plotted_.size();
    QCPGraph* graph = addGraph();
    graph->setPen(curvePen(row, whole, theme_));
    graph->setAdaptiveSampling(false);  // thinned already
    graphRows_.push_back(row);
    graphValues_.push_back(std::move(values));
  }
  yAxis->setRange(0.0, largest > 0.0 ? largest * kHeadroom : 1.0);
  if (recording_) {
    const auto& gaps = recording_->timing.gaps;
    for (std::size_t i = 0; i < std::min(gaps.size(), kMostGapMarks); ++i) {
      const double begin = recording_->timeS[gaps[i].frame];
      shadeSpan(*this, begin, begin + gaps[i].seconds, theme_);
      auto* label = wordAt(*this,
                           begin + gaps[i].seconds / 2,
                           "gap " + QString::number(gaps[i].seconds, 'f', 1) + " s",
                           Qt::AlignHCenter,
                           colorsOf(theme_).warning);
      gapLabels_.push_back(label);
    }
  }
  refill();
}

void TimelineChart::nameAxis() { yAxis->setLabel(signalAxisName(signal_, *this)); }

void TimelineChart::refill() {
  const QCPRange range = xAxis->range();
  const DecimationOptions options{
      .from = range.lower,
      .to = range.upper,
      .columns = static_cast<std::size_t>(std::max(1, width())),
      .breaks = recording_ ? std::span<const std::size_t>(recording_->gapFrames)
                           : std::span<const std::size_t>()};
  for (std::size_t g = 0; g < graphRows_.size(); ++g) {
    const auto points = minMaxDecimated(recording_->timeS, graphValues_[g], options);
    QVector<QCPGraphData> samples;
    samples.reserve(static_cast<qsizetype>(points.size()));
    for (const SeriesPoint& point : points) samples.append({point.x, point.y});
    graph(static_cast<int>(g))->data()->set(samples, true);
  }
  showGapLabels();
  replot(QCustomPlot::rpQueuedReplot);
}

// A label stands only in a gap that is wide enough for it.
void TimelineChart::showGapLabels() {
  for (std::size_t i = 0; i < gapLabels_.size(); ++i) {
    const Gap& gap = recording_->timing.gaps[i];
    const double begin = recording_->timeS[gap.frame];
    const double widthPx = pixelOf(begin + gap.seconds) - pixelOf(begin);
    gapLabels_[i]->setVisible(widthPx > fontMetrics().horizontalAdvance(gapLabels_[i]->text()) + 6);
  }
}

void TimelineChart::setPosition(double seconds) {
  positionS_ = seconds;
  const QCPRange range = xAxis->range();
  if (recording_ && !panning_ && (seconds < range.lower || seconds > range.upper)) {
    const double span = range.size();
    const double from =
        seconds > range.upper ? seconds - kPageRest * span : seconds - (1.0 - kPageRest) * span;
    setSeen(from, from + span);
  }
  placeCursor();
}

void TimelineChart::placeCursor() {
  const QRect plot = axisRect()->rect();
  const int x = static_cast<int>(std::lround(pixelOf(positionS_)));
  const bool inside = recording_ && x >= plot.left() - 1 && x <= plot.right() + 2;
  const QRect place(x - kCursorWidth / 2, plot.top(), kCursorWidth, plot.height());
  if (cursor_->geometry() != place) cursor_->setGeometry(place);
  if (cursor_->isHidden() == inside) cursor_->setVisible(inside);
}

void TimelineChart::setSeen(double from, double to) {
  const double duration = durationS();
  const double span = std::clamp(to - from, std::min(kShortestSeenS, duration), duration);
  const double start = std::clamp(from, 0.0, duration - span);
  xAxis->setRange(start, start + span);
  refill();
}

void TimelineChart::fit() { setSeen(0.0, durationS()); }

void TimelineChart::zoom(double factor) { zoomAbout(xAxis->range().center(), factor); }

void TimelineChart::zoomAbout(double seconds, double factor) {
  const QCPRange range = xAxis->range();
  const double span =
      std::clamp(range.size() / factor, std::min(kShortestSeenS, durationS()), durationS());
  const double share = (seconds - range.lower) / range.size();
  setSeen(seconds - share * span, seconds + (1.0 - share) * span);
}

void TimelineChart::mousePressEvent(QMouseEvent* event) {
  if (!recording_) return;
  const bool shifted = event->button() == Qt::LeftButton && event->modifiers() & Qt::ShiftModifier;
  panning_ = shifted || event->button() == Qt::MiddleButton;
  if (panning_) {
    panFromPixel_ = event->position().x();
    panFrom_ = xAxis->range();
    setCursor(Qt::ClosedHandCursor);
  } else if (event->button() == Qt::LeftButton) {
    emit sought(secondsAt(event->position().x()));
  }
}

void TimelineChart::mouseMoveEvent(QMouseEvent* event) {
  if (panning_) {
    const double perPixel = panFrom_.size() / std::max(1, axisRect()->width());
    const double moved = (panFromPixel_ - event->position().x()) * perPixel;
    setSeen(panFrom_.lower + moved, panFrom_.upper + moved);
  } else if (event->buttons() & Qt::LeftButton) {
    emit sought(secondsAt(event->position().x()));
  }
}

void TimelineChart::mouseReleaseEvent(QMouseEvent*) {
  panning_ = false;
  unsetCursor();
}

void TimelineChart::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) fit();
}

void TimelineChart::wheelEvent(QWheelEvent* event) {
  if (!recording_) return;
  const double notches = event->angleDelta().y() / kNotch;
  const double sideways = event->angleDelta().x() / kNotch;
  if (sideways != 0.0 || event->modifiers() & Qt::ShiftModifier) {
    const QCPRange range = xAxis->range();
    const double moved = -(sideways != 0.0 ? sideways : notches) * kPageRest * range.size();
    setSeen(range.lower + moved, range.upper + moved);
  } else {
    zoomAbout(secondsAt(event->position().x()), std::pow(kWheelStep, notches));
  }
  event->accept();
}

void TimelineChart::resizeEvent(QResizeEvent* event) {
  QCustomPlot::resizeEvent(event);
  nameAxis();
  refill();
}

QString TimelineChart::valuesAt(double seconds) const {
  if (!recording_ || recording_->timeS.empty() || seconds < 0.0 || seconds > durationS()) return {};
  const auto& times = recording_->timeS;
  const auto after = std::upper_bound(times.begin(), times.end(), seconds);
  const auto frame =
      static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, after - times.begin() - 1));
  QString text = QString::number(times[frame], 'f', 2) + " s · frame " + QString::number(frame);
  if (const Gap* gap = recording_->gapAt(seconds))
    return text + "\ngap of " + QString::number(gap->seconds, 'f', 1) + " s: nothing was recorded";
  for (std::size_t g = 0; g < graphRows_.size(); ++g) {
    const std::size_t row = graphRows_[g];
    const QString name = row == recording_->numMatrices()
                             ? QString("all")
                             : QString::fromStdString(recording_->profile.hand().matrixName(row));
    text += "\n" + name + "  " + QString::number(graphValues_[g][frame], 'f', 0) + " " +
            unitOf(signal_);
  }
  return text;
}

bool TimelineChart::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    QToolTip::showText(help->globalPos(), valuesAt(secondsAt(help->pos().x())), this);
    return true;
  }
  if (event->type() == QEvent::FontChange) setTheme(theme_);
  return QCustomPlot::event(event);
}

}  // namespace palpate::gui

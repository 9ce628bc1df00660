#include "gui/calibrate/force_chart.h"

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

enum Graph { kLow, kHigh, kForce, kBeyond };
constexpr double kForceChartSigmas = 1.96;  // standard deviations: a band of 95 %
constexpr double kForceChartHeadroom = 1.1;
constexpr int kForceChartBandAlpha = 46;
// Most points that are drawn; with more frames, the largest value of each group of frames.
constexpr std::size_t kForceChartMostPoints = 20'000;

}  // namespace

ForceChart::ForceChart(QWidget* parent) : QCustomPlot(parent) {
  setObjectName("forceChart");
  setAccessibleName("Force over time");
  arrangeChart(*this);
  setMouseTracking(true);
  for (int i = 0; i <= kBeyond; ++i) addGraph();
  graph(kLow)->setPen(Qt::NoPen);
  graph(kHigh)->setPen(Qt::NoPen);
  graph(kHigh)->setChannelFillGraph(graph(kLow));
  xAxis->setLabel("time from the first frame in s");
  cursor_ = new QWidget(this);
  cursor_->setAttribute(Qt::WA_TransparentForMouseEvents);
  connect(this, &QCustomPlot::afterReplot, this, &ForceChart::placeCursor);
  style();
}

void ForceChart::setSeries(const std::shared_ptr<const ForceSeries>& series) {
  series_ = series;
  fill();
}

void ForceChart::choose(std::size_t matrix, const QString& name) {
  matrix_ = matrix;
  name_ = name;
  fill();
}

void ForceChart::fill() {
  QVector<QCPGraphData> low, high, force, beyond;
  double most = 0.0;
  if (series_ && !series_->timeS.empty()) {
    const bool whole = matrix_ >= series_->numMatrices;
    const std::size_t numFrames = series_->timeS.size();
    const auto value = [&](std::size_t i) {
      return whole ? series_->forceN(i) : static_cast<double>(series_->at(i, matrix_).forceN);
    };
    const auto outside = [&](std::size_t i) {
      for (std::size_t m = 0; m < series_->numMatrices; ++m)
        if ((whole || m == matrix_) && !series_->at(i, m).inRange) return true;
      return false;
    };
    const std::size_t bunch = numFrames / kForceChartMostPoints + 1;
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t first = 0; first < numFrames; first += bunch) {
      std::size_t at = first;
      for (std::size_t i = first; i < std::min(first + bunch, numFrames); ++i)
        if (value(i) > value(at)) at = i;
      const double t = series_->timeS[at], n = value(at);
      const double sd =
          whole ? series_->sdForceN(at) : static_cast<double>(series_->at(at, matrix_).sdForceN);
      low.append({t, std::max(0.0, n - kForceChartSigmas * sd)});
      high.append({t, n + kForceChartSigmas * sd});
      force.append({t, n});
      beyond.append({t, outside(at) ? n : nothing});
      most = std::max(most, n + kForceChartSigmas * sd);
    }
    xAxis->setRange(series_->timeS.front(),
                    std::max(series_->timeS.back(), series_->timeS.front() + 1e-3));
  }
  graph(kLow)->data()->set(low, true);
  graph(kHigh)->data()->set(high, true);
  graph(kForce)->data()->set(force, true);
  graph(kBeyond)->data()->set(beyond, true);
  yAxis->setRange(0.0, (most > 0.0 ? most : 1.0) * kForceChartHeadroom);
  style();
}

void ForceChart::setTheme(Theme theme) {
  theme_ = theme;
  style();
}

void ForceChart::style() {
  const ThemeColors& colors = colorsOf(theme_);
  styleChart(*this, theme_);
  const bool isLimit = series_ && !series_->areaKnown;
  yAxis->setLabel(isLimit ? fittingName("upper limit of the force in N", "≤ N", *this)
                          : fittingName("force in N", "N", *this));
  const bool whole = !series_ || matrix_ >= series_->numMatrices;
  const QColor color = whole ? wholeColor(theme_) : matrixColor(matrix_, theme_);
  QColor shade = color;
  shade.setAlpha(kForceChartBandAlpha);
  graph(kHigh)->setBrush(shade);
  graph(kForce)->setPen(QPen(color, 1.4));
  graph(kBeyond)->setPen(QPen(colors.warning, 1.8));
  cursor_->setStyleSheet("background: " + colors.accent.name());
  replot(QCustomPlot::rpQueuedReplot);
}

void ForceChart::setVisibleRange(double fromS, double toS) {
  if (!(toS > fromS)) return;
  xAxis->setRange(fromS, toS);
  replot(QCustomPlot::rpQueuedReplot);
}

void ForceChart::setPosition(double seconds) {
  positionS_ = seconds;
  placeCursor();
}

void ForceChart::placeCursor() {
  const QRect plot = axisRect()->rect();
  const int x = static_cast<int>(std::lround(xAxis->coordToPixel(positionS_)));
  const bool inside = x >= plot.left() && x <= plot.right() + 1;
  cursor_->setGeometry(x - 1, plot.top(), 2, plot.height());
  if (cursor_->isHidden() == inside) cursor_->setVisible(inside);
}

void ForceChart::paint(QPainter& painter, const PictureLook& look, const QString& title) {
  const QColor color = graph(kForce)->pen().color();
  paintChart(painter,
             look,
             *this,
             {.title = title,
              .legend = {{name_ + ", ± 95 %", QPen(color, 1.4)},
                         {"outside the measured range", graph(kBeyond)->pen()}}});
}

void ForceChart::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton)
    emit seekRequested(xAxis->pixelToCoord(event->position().x()));
}

void ForceChart::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton)
    emit seekRequested(xAxis->pixelToCoord(event->position().x()));
}

bool ForceChart::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip && series_ && !series_->timeS.empty()) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const std::size_t i = series_->frameAt(xAxis->pixelToCoord(help->pos().x()));
    const bool whole = matrix_ >= series_->numMatrices;
    const double n =
        whole ? series_->forceN(i) : static_cast<double>(series_->at(i, matrix_).forceN);
    QToolTip::showText(
        help->globalPos(), figure(series_->timeS[i], 2) + " s\n" + figure(n, 2) + " N", this);
    return true;
  }
  if (event->type() == QEvent::FontChange || event->type() == QEvent::Resize) style();
  return QCustomPlot::event(event);
}

}  // namespace palpate::gui

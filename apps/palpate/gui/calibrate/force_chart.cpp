#include "gui/calibrate/force_chart.h"

#include <algorithm>
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

ForceChart::ForceChart(QWidget* parent) : Chart(parent) {
  setObjectName("forceChart");
  setAccessibleName("Force over time");
  for (int i = 0; i <= kBeyond; ++i) addGraph();
  graph(kLow)->setPen(Qt::NoPen);
  graph(kHigh)->setPen(Qt::NoPen);
  graph(kHigh)->setChannelFillGraph(graph(kLow));
  xAxis->setLabel("time from the first frame in s");
  addCursor();
  restyle();
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
  restyle();
}

void ForceChart::style() {
  const bool isLimit = series_ && !series_->areaKnown;
  yAxis->setLabel(isLimit ? fittingName("upper limit of the force in N", "≤ N", *this)
                          : fittingName("force in N", "N", *this));
  const bool whole = !series_ || matrix_ >= series_->numMatrices;
  const QColor color = whole ? wholeColor() : matrixColor(matrix_);
  QColor shade = color;
  shade.setAlpha(kForceChartBandAlpha);
  graph(kHigh)->setBrush(shade);
  graph(kForce)->setPen(QPen(color, 1.4));
  graph(kBeyond)->setPen(QPen(colorsOf().warning, 1.8));
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

QString ForceChart::readingAt(const QPointF& at) const {
  if (!series_ || series_->timeS.empty()) return {};
  const std::size_t i = series_->frameAt(secondsAt(at.x()));
  const bool whole = matrix_ >= series_->numMatrices;
  const double n = whole ? series_->forceN(i) : static_cast<double>(series_->at(i, matrix_).forceN);
  return figure(series_->timeS[i], 2) + " s\n" + figure(n, 2) + " N";
}

}  // namespace palpate::gui

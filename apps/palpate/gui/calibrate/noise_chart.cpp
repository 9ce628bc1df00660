#include "gui/calibrate/noise_chart.h"

#include <algorithm>
#include <limits>

#include "gui/chart/chart_picture.h"
#include "gui/chart/chart_style.h"

namespace palpate::gui {
namespace {

constexpr double kNoiseChartSigmas = 3.0;
constexpr double kNoiseChartAir = 0.06;  // margin, as a part of the range
constexpr int kNoiseChartBandAlpha = 40;
constexpr double kBinSize = 5.0;  // [px]

struct NoiseChartExtent {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  QCPRange range() const {
    if (low > high) return {0.0, 1.0};
    const double air = high > low ? (high - low) * kNoiseChartAir : 1.0;
    return {low - air, high + air};
  }
};

}  // namespace

NoiseChart::NoiseChart(QWidget* parent) : Chart(parent) {
  setObjectName("noiseChart");
  setAccessibleName("Noise over temperature");
  xAxis->setLabel("temperature of the nearest motor in °C");
  restyle();
}

void NoiseChart::setFloor(const NoiseFloor& floor, const QStringList& names) {
  floor_ = floor;
  names_ = names;
  chosen_ = 0;
  restyle();
}

void NoiseChart::choose(std::size_t matrix) {
  if (matrix == chosen_ || matrix >= floor_.lines.size()) return;
  chosen_ = matrix;
  restyle();
}

void NoiseChart::style() {
  clearPlottables();
  yAxis->ticker()->setTickCount(6);
  yAxis->setLabel(fittingName("largest reading in counts", "counts", *this));
  NoiseChartExtent degrees, counts;
  for (std::size_t i = 0; i < floor_.lines.size(); ++i) {
    const NoiseLine& line = floor_.lines[i];
    const bool chosen = i == chosen_;
    const QColor color = matrixColor(line.matrix);
    const double ends[] = {line.minDegC, line.maxDegC};
    if (line.valid) {
      const auto draw = [&](double offset) {
        QCPGraph* made = addGraph();
        for (const double degC : ends) made->addData(degC, line.at(degC) + offset);
        for (const double degC : ends)
          if (chosen || offset == 0.0) counts.add(line.at(degC) + offset);
        return made;
      };
      for (const double degC : ends) degrees.add(degC);
      if (chosen) {
        QCPGraph* low = draw(-kNoiseChartSigmas * line.rmse);
        QCPGraph* high = draw(kNoiseChartSigmas * line.rmse);
        QColor shade = color;
        shade.setAlpha(kNoiseChartBandAlpha);
        low->setPen(QPen(color, 1.0, Qt::DotLine));
        high->setPen(QPen(color, 1.0, Qt::DashLine));
        high->setBrush(shade);
        high->setChannelFillGraph(low);
        high->setName("+ 3 RMSE: the threshold");
      }
      QCPGraph* middle = draw(0.0);
      middle->setPen(QPen(color, chosen ? 2.2 : 1.2));
      middle->setName(names_.value(static_cast<qsizetype>(i)));
    }
    if (!chosen) continue;
    QCPGraph* bins = addGraph();
    auto* bars = new QCPErrorBars(xAxis, yAxis);
    bars->setDataPlottable(bins);
    for (const NoiseBin& bin : line.bins) {
      if (bin.count == 0) continue;
      bins->addData(bin.centreDegC, bin.mean);
      bars->addData(bin.sd);
      degrees.add(bin.centreDegC);
      counts.add(bin.mean - bin.sd);
      counts.add(bin.mean + bin.sd);
    }
    bins->setLineStyle(QCPGraph::lsNone);
    bins->setPen(QPen(color, 1.2));
    bins->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssDisc, color, color, kBinSize));
    bins->setName("bins, ± sd");
    bars->setPen(QPen(color, 1.0));
    bars->setAntialiased(false);
  }
  xAxis->setRange(degrees.range());
  yAxis->setRange(counts.range());
}

void NoiseChart::paint(QPainter& painter, const PictureLook& look, const QString& title) {
  paintChart(painter, look, *this, {.title = title, .caption = "noise of an unloaded hand"});
}

}  // namespace palpate::gui

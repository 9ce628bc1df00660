#include "gui/calibrate/pressure_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <palpate/calibration/student_t.h>

#include "gui/appearance/captions.h"
#include "gui/chart/chart_picture.h"
#include "gui/chart/chart_style.h"

namespace palpate::gui {
namespace {

constexpr int kSlicePoints = 120;
constexpr double kPressureChartHeadroom = 1.12;
constexpr int kPressureChartBandAlpha = 36;
constexpr double kPressureChartPointSize = 6.0;  // [px]
constexpr double kChosenSize = 11.0;             // [px]
constexpr double kSame = 0.05;                   // [deg C]; closer temperatures count as equal
constexpr std::size_t kCold = 5, kWarm = 3;      // matrices with those colours: blue, red

}  // namespace

double temperatureOf(const PressureSample& sample, const PressureModelOptions& options) {
  const auto& degC = options.study ? sample.studyDegC : sample.nearestDegC;
  return degC.value_or(options.assumedDegC);
}

std::vector<double> sliceTemperatures(const PressureModel& model,
                                      const std::vector<PressureSample>& samples) {
  double least = std::numeric_limits<double>::max(), most = std::numeric_limits<double>::lowest();
  for (const PressureSample& sample : samples) {
    if (!sample.used) continue;
    least = std::min(least, temperatureOf(sample, model.options));
    most = std::max(most, temperatureOf(sample, model.options));
  }
  if (least > most) return {model.options.assumedDegC};
  if (most - least < kSame) return {least};
  return {least, (least + most) / 2.0, most};
}

PressureChart::PressureChart(QWidget* parent) : Chart(parent) {
  setObjectName("pressureChart");
  setAccessibleName("Pressure over gain at three temperatures");
  xAxis->setLabel("gain K in counts");
  legend->setVisible(true);
  axisRect()->insetLayout()->setInsetAlignment(0, Qt::AlignTop | Qt::AlignLeft);
  restyle();
}

void PressureChart::setModel(const PressureModel& model,
                             const std::vector<PressureSample>& samples) {
  model_ = model;
  samples_ = samples;
  chosen_.reset();
  restyle();
}

void PressureChart::choose(std::optional<std::size_t> sample) {
  if (sample == chosen_) return;
  chosen_ = sample;
  restyle();
}

void PressureChart::addSlice(
    double degC, const QColor& color, double fromK, double toK, bool band) {
  const double dof =
      static_cast<double>(model_.gain.numPoints) - static_cast<double>(model_.gain.numTerms);
  const double quantile = studentQuantile975(dof);
  QVector<QCPGraphData> inside, outside, low, high;
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i <= kSlicePoints; ++i) {
    const double k = fromK + (toK - fromK) * i / kSlicePoints;
    const PressureEstimate estimate = model_.pressureAt(k, degC);
    inside.append({k, estimate.inRange ? estimate.kpa : nothing});
    outside.append({k, estimate.inRange ? nothing : estimate.kpa});
    low.append({k, std::max(0.0, estimate.kpa - quantile * estimate.sdKpa)});
    high.append({k, estimate.kpa + quantile * estimate.sdKpa});
  }
  const auto add = [&](const QVector<QCPGraphData>& samples, const QPen& pen, const QString& name) {
    QCPGraph* made = addGraph();
    made->data()->set(samples, true);
    made->setPen(pen);
    if (name.isEmpty()) {
      made->removeFromLegend();
    } else {
      made->setName(name);
    }
    return made;
  };
  if (band && std::isfinite(quantile)) {
    QColor shade = color;
    shade.setAlpha(kPressureChartBandAlpha);
    QCPGraph* under = add(low, Qt::NoPen, {});
    QCPGraph* above = add(high, Qt::NoPen, {});
    above->setBrush(shade);
    above->setChannelFillGraph(under);
  }
  const bool measured = std::any_of(
      inside.begin(), inside.end(), [](const QCPGraphData& at) { return !std::isnan(at.value); });
  const QString name = figure(degC, 1) + " °C" + (band ? ", 95 % band" : "");
  add(inside, QPen(color, 1.8), measured ? name : QString());
  add(outside, QPen(color, 1.0, Qt::DashLine), measured ? QString() : name);
}

void PressureChart::style() {
  clearPlottables();
  const ThemeColors& colors = colorsOf();
  yAxis->ticker()->setTickCount(6);
  yAxis->setLabel(fittingName("pressure in kPa", "kPa", *this));
  double mostK = 0.0, mostKpa = 0.0, leastK = std::numeric_limits<double>::max();
  for (const PressureSample& sample : samples_) {
    mostK = std::max(mostK, sample.staticResponseCounts);
    if (sample.used) leastK = std::min(leastK, sample.staticResponseCounts);
    mostKpa = std::max(mostKpa, sample.pressureKpa);
  }
  if (leastK > mostK) leastK = 0.0;
  for (const SurfacePoint& corner : model_.gain.hull) {
    mostK = std::max(mostK, corner.x);
    leastK = std::min(leastK, corner.x);
  }
  if (!(mostK > 0.0)) mostK = 1.0;
  const double fromK = std::max(0.0, leastK - 0.15 * (mostK - leastK)), toK = mostK * 1.06;
  const std::vector<double> slices = sliceTemperatures(model_, samples_);
  const auto colorAt = [&](std::size_t i) {
    return slices.size() == 1 || i == 1 ? wholeColor() : matrixColor(i == 0 ? kCold : kWarm);
  };
  if (model_.valid())
    for (std::size_t i = 0; i < slices.size(); ++i) {
      const bool band = slices.size() == 1 || i == 1;
      addSlice(slices[i], colorAt(i), fromK, toK, band);
      mostKpa = std::max(mostKpa, model_.pressureAt(mostK, slices[i]).kpa);
    }
  std::vector<QCPGraph*> points;
  const auto scatter = [&](const QColor& color, QCPScatterStyle::ScatterShape shape) {
    QCPGraph* made = addGraph();
    made->setLineStyle(QCPGraph::lsNone);
    made->setPen(QPen(color, 1.2));
    made->setScatterStyle(QCPScatterStyle(shape, QPen(color, 1.2), color, kPressureChartPointSize));
    made->removeFromLegend();
    return made;
  };
  for (std::size_t i = 0; i < slices.size(); ++i)
    points.push_back(scatter(colorAt(i), QCPScatterStyle::ssDisc));
  QCPGraph* unused = scatter(colors.muted, QCPScatterStyle::ssCross);
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    const PressureSample& sample = samples_[s];
    std::size_t nearest = 0;
    const double degC = temperatureOf(sample, model_.options);
    for (std::size_t i = 1; i < slices.size(); ++i)
      if (std::abs(slices[i] - degC) < std::abs(slices[nearest] - degC)) nearest = i;
    if (sample.used)
      points[nearest]->addData(sample.staticResponseCounts, sample.pressureKpa);
    else if (sample.staticResponseCounts > 0.0)
      unused->addData(sample.staticResponseCounts, sample.pressureKpa);
    if (chosen_ != s || (!sample.used && sample.staticResponseCounts <= 0.0)) continue;
    QCPGraph* ring = scatter(colors.accent, QCPScatterStyle::ssCircle);
    ring->setScatterStyle(QCPScatterStyle(
        QCPScatterStyle::ssCircle, QPen(colors.accent, 2.0), Qt::NoBrush, kChosenSize));
    ring->addData(sample.staticResponseCounts, sample.pressureKpa);
  }
  xAxis->setRange(fromK, toK);
  yAxis->setRange(0.0, (mostKpa > 0.0 ? mostKpa : 1.0) * kPressureChartHeadroom);
}

void PressureChart::paint(QPainter& painter, const PictureLook& look, const QString& title) {
  // The exported picture has its own legend.
  legend->setVisible(false);
  paintChart(painter, look, *this, {.title = title, .caption = "P(K, T)"});
  legend->setVisible(true);
}

}  // namespace palpate::gui

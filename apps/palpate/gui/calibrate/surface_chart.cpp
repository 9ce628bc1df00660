#include "gui/calibrate/surface_chart.h"

#include <algorithm>

#include <palpate/calibration/student_t.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/color_map.h"
#include "gui/calibrate/pressure_chart.h"
#include "gui/chart/chart_picture.h"
#include "gui/chart/chart_style.h"

namespace palpate::gui {
namespace {

constexpr int kAcross = 120, kUp = 80;     // number of cells
constexpr double kSurfaceChartAir = 0.12;  // margin beside the samples, as a part of the span
constexpr double kMinSpanDegC = 4.0;
constexpr double kSurfaceChartPointSize = 7.0, kSurfaceChartChosenSize = 12.0;  // [px]
constexpr int kBeyondAlpha = 90;  // of 255; opacity outside the measured region

QCPColorGradient gradient() {
  QCPColorGradient colors;
  colors.clearColorStops();
  const ColorTable& table = colorTable(ColorMapName::kViridis);
  constexpr std::size_t kStops = 16;
  for (std::size_t i = 0; i <= kStops; ++i)
    colors.setColorStopAt(static_cast<double>(i) / kStops,
                          QColor(table[i * (table.size() - 1) / kStops]));
  return colors;
}

}  // namespace

SurfaceChart::SurfaceChart(QWidget* parent) : Chart(parent) {
  setObjectName("surfaceChart");
  setAccessibleName("Pressure over gain and temperature");
  scale_ = new QCPColorScale(this);
  plotLayout()->addElement(0, 1, scale_);
  scale_->setType(QCPAxis::atRight);
  scale_->setBarWidth(10);
  auto* margins = new QCPMarginGroup(this);
  for (QCPLayoutElement* each : std::initializer_list<QCPLayoutElement*>{axisRect(), scale_})
    each->setMarginGroup(QCP::msTop | QCP::msBottom, margins);
  restyle();
}

void SurfaceChart::setModel(const PressureModel& model,
                            const std::vector<PressureSample>& samples) {
  model_ = model;
  samples_ = samples;
  chosen_.reset();
  restyle();
}

void SurfaceChart::choose(std::optional<std::size_t> sample) {
  if (sample == chosen_) return;
  chosen_ = sample;
  restyle();
}

void SurfaceChart::style() {
  clearPlottables();
  const ThemeColors& colors = colorsOf();
  xAxis->setLabel("gain K in counts");
  yAxis->setLabel(fittingName("temperature in °C", "°C", *this));
  yAxis->ticker()->setTickCount(5);
  QCPAxis& bar = *scale_->axis();
  bar.setLabel("kPa");
  styleExtraAxis(bar, *this);
  double leastK = 0.0, mostK = 1.0, leastT = 30.0, mostT = 30.0;
  bool any = false;
  for (const PressureSample& sample : samples_) {
    if (!sample.used) continue;
    const double degC = temperatureOf(sample, model_.options);
    leastK = any ? std::min(leastK, sample.staticResponseCounts) : sample.staticResponseCounts;
    mostK = any ? std::max(mostK, sample.staticResponseCounts) : sample.staticResponseCounts;
    leastT = any ? std::min(leastT, degC) : degC;
    mostT = any ? std::max(mostT, degC) : degC;
    any = true;
  }
  const double airK = kSurfaceChartAir * std::max(mostK - leastK, 1.0);
  const double airT =
      std::max(kSurfaceChartAir * (mostT - leastT), 0.5 * (kMinSpanDegC - (mostT - leastT)));
  const QCPRange k(std::max(0.0, leastK - airK), mostK + airK), t(leastT - airT, mostT + airT);
  xAxis->setRange(k);
  yAxis->setRange(t);
  scale_->setVisible(model_.valid());
  if (model_.valid()) {
    auto* map = new QCPColorMap(xAxis, yAxis);
    map->data()->setSize(kAcross, kUp);
    map->data()->setRange(k, t);
    double least = 0.0, most = 0.0;
    for (int x = 0; x < kAcross; ++x)
      for (int y = 0; y < kUp; ++y) {
        double atK = 0.0, atT = 0.0;
        map->data()->cellToCoord(x, y, &atK, &atT);
        const PressureEstimate estimate = model_.pressureAt(atK, atT);
        map->data()->setCell(x, y, estimate.kpa);
        if (!estimate.inRange) map->data()->setAlpha(x, y, kBeyondAlpha);
        if (estimate.inRange) least = std::min(least, estimate.kpa);
        if (estimate.inRange) most = std::max(most, estimate.kpa);
      }
    map->setInterpolate(false);
    map->setGradient(gradient());
    map->setColorScale(scale_);
    scale_->setGradient(gradient());
    scale_->setDataRange({least, std::max(most, least + 1.0)});
    const auto& hull = model_.gain.hull;
    if (hull.size() > 1) {
      auto* outline = new QCPCurve(xAxis, yAxis);
      for (std::size_t i = 0; i <= hull.size(); ++i)
        outline->addData(hull[i % hull.size()].x, hull[i % hull.size()].t);
      outline->setPen(QPen(colors.text, 1.2, Qt::DashLine));
    }
  }
  addPoints();
}

void SurfaceChart::addPoints() {
  const ThemeColors& colors = colorsOf();
  const auto scatter = [&](const QCPScatterStyle& style) {
    QCPGraph* made = addGraph();
    made->setLineStyle(QCPGraph::lsNone);
    made->setScatterStyle(style);
    return made;
  };
  QCPGraph* used = scatter(
      {QCPScatterStyle::ssDisc, QPen(colors.window, 1.2), colors.text, kSurfaceChartPointSize});
  QCPGraph* unused = scatter(
      {QCPScatterStyle::ssCross, QPen(colors.muted, 1.2), Qt::NoBrush, kSurfaceChartPointSize});
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    const PressureSample& sample = samples_[s];
    if (!(sample.staticResponseCounts > 0.0)) continue;
    const double degC = temperatureOf(sample, model_.options);
    (sample.used ? used : unused)->addData(sample.staticResponseCounts, degC);
    if (chosen_ == s)
      scatter({QCPScatterStyle::ssCircle,
               QPen(colors.accent, 2.0),
               Qt::NoBrush,
               kSurfaceChartChosenSize})
          ->addData(sample.staticResponseCounts, degC);
  }
}

QString SurfaceChart::readingAt(const QPointF& at) const {
  if (!model_.valid() || !axisRect()->rect().contains(at.toPoint())) return {};
  const double k = xAxis->pixelToCoord(at.x()), degC = yAxis->pixelToCoord(at.y());
  const PressureEstimate estimate = model_.pressureAt(k, degC);
  const double dof =
      static_cast<double>(model_.gain.numPoints) - static_cast<double>(model_.gain.numTerms);
  return "K " + figure(k, 0) + " counts, " + figure(degC, 1) + " °C: " + figure(estimate.kpa, 1) +
         " ± " + figure(studentQuantile975(dof) * estimate.sdKpa, 1) + " kPa" +
         (estimate.inRange ? "" : ", outside the measured range");
}

void SurfaceChart::paint(QPainter& painter, const PictureLook& look, const QString& title) {
  paintChart(painter, look, *this, {.title = title, .caption = "P(K, T)"});
}

}  // namespace palpate::gui

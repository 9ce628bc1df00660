#include "palpate/calibration/pressure_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/core/number_text.h"
#include "palpate/core/statistics.h"

namespace palpate {
namespace {

constexpr double kOneTemperatureC =
    2.0;  // a smaller spread says nothing about the influence of temperature

std::optional<double> temperatureOf(const PressureSample& sample,
                                    const PressureModelOptions& options) {
  return options.study && sample.studyDegC ? sample.studyDegC : sample.nearestDegC;
}

bool plausible(const PressureSample& sample) {
  return sample.used && std::isfinite(sample.pressureKpa) &&
         std::isfinite(sample.staticResponseCounts) && std::isfinite(sample.driftCountsPerS);
}

void addAreaShare(std::span<const PressureSample> samples, PressureModel& model) {
  std::vector<double> shares;
  for (const PressureSample& sample : samples)
    if (plausible(sample) && sample.activeAreaMm2 > 0.0)
      shares.push_back(model.options.indenterAreaMm2 / sample.activeAreaMm2);
  if (!(model.options.indenterAreaMm2 > 0.0)) {
    model.notes.push_back(
        "the indenter's area isn't known (--area): forces include the whole area of every active "
        "taxel, although the rubber spreads a load to taxels around the indenter");
    return;
  }
  if (shares.empty()) return;
  double mean = 0.0, squares = 0.0;
  for (const double share : shares) mean += share / static_cast<double>(shares.size());
  for (const double share : shares) squares += (share - mean) * (share - mean);
  model.areaFraction = mean;
  model.areaFractionSd =
      shares.size() > 1 ? std::sqrt(squares / static_cast<double>(shares.size() - 1)) : 0.0;
}

double medianDurationS(std::span<const PressureSample> samples) {
  std::vector<double> durations;
  for (const PressureSample& sample : samples)
    if (plausible(sample) && sample.durationS > 0.0) durations.push_back(sample.durationS);
  return durations.empty() ? 0.0 : upperMedian(std::move(durations));
}

void addNotes(const std::vector<SurfacePoint>& points,
              std::size_t withoutTemperature,
              PressureModel& model) {
  const auto note = [&](std::string text) { model.notes.push_back(std::move(text)); };
  if (points.empty()) {
    note("no usable step: no model");
    return;
  }
  const auto [coldest, warmest] =
      std::minmax_element(points.begin(), points.end(), [](auto& a, auto& b) { return a.t < b.t; });
  if (withoutTemperature > 0)
    note(std::to_string(withoutTemperature) +
         " steps have no temperature: " + fixedText(model.options.assumedDegC, 0) + " °C assumed");
  if (warmest->t - coldest->t < kOneTemperatureC)
    note("one temperature only (" + fixedText(coldest->t, 1) + " to " + fixedText(warmest->t, 1) +
         " °C): the model is valid only there");
  if (!model.gain.valid)
    note("no P(K, T): " +
         (model.gain.notes.empty() ? std::string("see its notes") : model.gain.notes.back()));
  if (!model.drift.valid) note("no P(m, T); P(K, T) doesn't need it");
}

}  // namespace

void PressureModelOptions::validate() const {
  constexpr OptionCheck check{"PressureModelOptions"};
  check(OptionRange{-200.0, 200.0}, "assumedDegC", assumedDegC);
  check(assumedSdDegC > 0.0 && std::isfinite(assumedSdDegC), "assumedSdDegC", assumedSdDegC);
  check(kIndenterAreaMm2, "indenterAreaMm2", indenterAreaMm2);
}

PressureEstimate PressureModel::pressureAt(double staticResponseCounts,
                                           std::optional<double> degC) const {
  PressureEstimate estimate;
  estimate.temperatureKnown = degC && std::isfinite(*degC) && *degC != 0.0;
  const double t = estimate.temperatureKnown ? *degC : options.assumedDegC;
  const SurfaceEstimate at = gain.at(staticResponseCounts, t);
  estimate.kpa = std::isnan(at.value) ? at.value : std::max(at.value, 0.0);
  estimate.sdKpa = at.sd;
  if (!estimate.temperatureKnown)
    estimate.sdKpa = std::hypot(at.sd, at.byT * options.assumedSdDegC);
  estimate.inRange = at.inRange;
  estimate.tooLight = at.tooLight;
  estimate.kpaPerCount = at.byX;
  return estimate;
}

PressureModel fitPressureModel(std::span<const PressureSample> samples,
                               const PressureModelOptions& options) {
  options.validate();
  PressureModel model;
  model.options = options;
  std::vector<SurfacePoint> byGain, byDrift, driftByGain;
  std::size_t withoutTemperature = 0;
  for (const PressureSample& sample : samples) {
    if (!plausible(sample)) continue;
    const auto degC = temperatureOf(sample, options);
    if (!degC) ++withoutTemperature;
    const double t = degC.value_or(options.assumedDegC);
    byGain.push_back({sample.staticResponseCounts, t, sample.pressureKpa});
    byDrift.push_back({sample.driftCountsPerS, t, sample.pressureKpa});
    driftByGain.push_back({sample.staticResponseCounts, t, sample.driftCountsPerS});
  }
  const auto selection =
      options.study ? SurfaceSelection::kAllTerms : SurfaceSelection::kLeaveOneOut;
  model.gain = fitSurface(byGain, surfaceTerms(1), selection);
  model.drift = fitSurface(byDrift, surfaceTerms(2), selection);
  model.driftOfGain = fitSurface(driftByGain, surfaceTerms(1), SurfaceSelection::kLeaveOneOut);
  model.creepMeasuredS = medianDurationS(samples);
  addAreaShare(samples, model);
  addNotes(byGain, withoutTemperature, model);
  return model;
}

}  // namespace palpate

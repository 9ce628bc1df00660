#include "palpate/calibration/step_report.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

// Even in a steady contact, some taxels at its edge become active and inactive. Above this number
// of taxels per frame, the mean over active taxels jumps with them.
constexpr double kFlicker = 1.0;
// A step response fits a constant load within a few per cent; above this share the load changed.
constexpr double kBadRmseShare = 0.1;

// Returns whether the temperature is known; 0 means that the sensor has not reported yet.
bool measured(double degC) { return std::isfinite(degC) && degC != 0.0; }

std::optional<double> meanOf(const std::vector<double>& degC) {
  double sum = 0.0;
  int count = 0;
  for (const double t : degC)
    if (measured(t)) {
      sum += t;
      ++count;
    }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

// Sets the means over the step's frames, each with the sample of temperatures that belongs to it.
void addTemperatures(const Profile& profile, std::size_t matrix, FittedStep& fitted) {
  if (profile.numTemperatures() == 0) return;
  const auto& matrices = profile.hand().matrices;
  const std::size_t sensor =
      matrix < matrices.size() ? matrices[matrix].temperatureSensor.value_or(SIZE_MAX) : SIZE_MAX;
  const std::size_t studySample = std::min(matrix, profile.numTemperatures() - 1);
  fitted.studyDegC = meanOf(profile.temperatures(studySample).values);
  double nearest = 0.0, all = 0.0;
  std::size_t numNearest = 0, numAll = 0;
  for (std::size_t i = fitted.step.begin; i <= fitted.step.end; ++i) {
    const auto sample = profile.temperatureSampleAt(profile.frameTimeUs(i));
    if (!sample) return;
    const std::vector<double> degC = profile.temperatures(*sample).values;
    if (sensor < degC.size() && measured(degC[sensor])) {
      nearest += degC[sensor];
      ++numNearest;
    }
    if (const auto mean = meanOf(degC)) {
      all += *mean;
      ++numAll;
    }
  }
  if (numNearest > 0) fitted.nearestDegC = nearest / static_cast<double>(numNearest);
  if (numAll > 0) fitted.allSensorsDegC = all / static_cast<double>(numAll);
}

void assess(const StepSignal& signal, double taxelAreaMm2, FittedStep& fitted) {
  const LoadingStep& step = fitted.step;
  const auto note = [&](std::string text) { fitted.notes.push_back(std::move(text)); };
  const std::size_t frames = step.end - step.begin + 1;
  fitted.durationS = signal.timeS[step.end] - signal.timeS[step.begin];
  if (!step.beginSeen)
    note(
        "loaded from the first frame on: the time of loading is not known, so K is only "
        "approximate");
  if (!signal.saturatedTaxels.empty()) {
    for (std::size_t i = step.begin; i <= step.end; ++i)
      if (signal.saturatedTaxels[i] > 0) ++fitted.saturatedFrames;
    if (fitted.saturatedFrames > 0)
      note("taxels are saturated in " + std::to_string(fitted.saturatedFrames) + " of " +
           std::to_string(frames) + " frames: K is too small; lower the sensitivity");
  }
  if (!signal.activeTaxels.empty()) {
    const std::size_t middle = step.begin + frames / 2;
    double active = 0.0;
    for (std::size_t i = middle; i <= step.end; ++i) active += signal.activeTaxels[i];
    fitted.activeAreaMm2 = active / static_cast<double>(step.end - middle + 1) * taxelAreaMm2;
  }
  if (!signal.toggledTaxels.empty()) {
    const std::size_t middle = step.begin + frames / 2;
    double switched = 0.0;
    for (std::size_t i = middle; i <= step.end; ++i) switched += signal.toggledTaxels[i];
    fitted.toggledPerFrame = switched / static_cast<double>(step.end - middle + 1);
    if (fitted.toggledPerFrame > kFlicker)
      note("flickering: " + fixedText(fitted.toggledPerFrame, 1) +
           " taxels come or go in each frame, and the mean over active taxels with them; raise the "
           "sensitivity or "
           "lower the threshold");
  }
  if (step.flickerFrames > 0)
    note("bridged: " + counted(step.flickerFrames, "frame") + " without any active taxel");
  const StepFit& fit = fitted.fit;
  if (fit.converged && fit.rmse > kBadRmseShare * std::abs(fit.parameters.staticResponseCounts))
    note("the residuals are " +
         fixedText(100.0 * fit.rmse / std::abs(fit.parameters.staticResponseCounts), 0) +
         " % of K: no single load that stayed");
}

Json numbers(const StepFit& fit) {
  Json rows = Json::array();
  for (int r = 0; r < 4; ++r) {
    Json row = Json::array();
    for (int c = 0; c < 4; ++c) row.push(fit.covariance(r, c));
    rows.push(std::move(row));
  }
  return rows;
}

Json jsonOf(const FittedStep& fitted) {
  const StepFit& fit = fitted.fit;
  const StepParameters& p = fit.parameters;
  Json json = Json::object();
  json.set("begin", fitted.step.begin).set("end", fitted.step.end);
  if (fit.converged) {
    json.set("K", p.staticResponseCounts)
        .set("m", p.driftCountsPerS)
        .set("T1", p.t1S())
        .set("T2", p.t2S());
    json.set("T", p.timeConstantS).set("d", p.damping).set("rmse", fit.rmse);
  } else {
    for (const char* key : {"K", "m", "T1", "T2", "T", "d", "rmse"}) json.set(key, Json());
  }
  json.set("converged", fit.converged).set("identifiable", fit.identifiable);
  json.set("time_constants_identifiable", fit.timesIdentifiable);
  json.set("covariance", numbers(fit));
  Json order = Json::array();
  const bool oscillating = fit.converged && p.damping < 1.0;
  for (const char* name : {"K", "m", oscillating ? "T" : "T1", oscillating ? "d" : "T2"})
    order.push(name);
  json.set("covariance_of", std::move(order));
  Json intervals = Json::array();
  for (int i = 0; i < 4; ++i) intervals.push(fit.interval95(i));
  json.set("interval95", std::move(intervals));
  json.set("gain_reached", fit.steadyStateReached).set("usable", fitted.usable());
  json.set("samples", fit.numSamples).set("dropped", fit.numDropped);
  json.set("downweighted", fit.numDownweighted);
  if (fit.converged) {
    const StepCharacteristics& c = fitted.characteristics;
    json.set("inflection_s", c.inflectionS).set("inflection_counts", c.inflectionCounts);
    json.set("tangent_per_s", c.tangentPerS).set("dead_time_s", c.deadTimeS);
    json.set("t_k_s", c.tangentAtGainS).set("equivalent_tangent_per_s", c.equivalentTangentPerS);
    json.set("steady_s", c.steadyS);
  }
  json.set("nearest_temperature_c", orNull(fitted.nearestDegC));
  json.set("mean_temperature_c", orNull(fitted.allSensorsDegC));
  json.set("study_temperature_c", orNull(fitted.studyDegC));
  json.set("duration_s", fitted.durationS);
  json.set("active_area_mm2", fitted.activeAreaMm2);
  json.set("saturated_frames", fitted.saturatedFrames);
  json.set("switched_taxels_per_frame", fitted.toggledPerFrame);
  json.set("released", fitted.step.released);
  std::vector<std::string> notes = fitted.notes;
  notes.insert(notes.end(), fit.notes.begin(), fit.notes.end());
  json.set("notes", jsonList(notes));
  return json;
}

}  // namespace

bool FittedStep::usable() const noexcept {
  return fit.usable() && step.beginSeen && saturatedFrames == 0 &&
         fit.rmse <= kBadRmseShare * std::abs(fit.parameters.staticResponseCounts);
}

StepSignal samplesOf(const StepSignal& signal, const LoadingStep& step) {
  StepSignal part;
  for (std::size_t i = step.begin; i <= step.end; ++i) {
    part.timeS.push_back(signal.timeS.at(i) - signal.timeS.at(step.begin));
    part.values.push_back(signal.values.at(i));
  }
  return part;
}

StepReport reportSteps(const Profile& profile,
                       std::size_t matrix,
                       const StepReportOptions& options,
                       const Progress& progress) {
  return reportSteps(
      profile, matrix, stepSignal(profile, matrix, options.steps.signal, progress), options);
}

StepReport reportSteps(const Profile& profile,
                       std::size_t matrix,
                       const StepSignal& signal,
                       const StepReportOptions& options) {
  StepReport report;
  report.matrix = matrix;
  report.signal = options.steps.signal;
  for (const LoadingStep& step : findLoadingSteps(signal, options.steps)) {
    FittedStep fitted;
    fitted.step = step;
    const StepSignal samples = samplesOf(signal, step);
    fitted.fit = fitStep(samples.timeS, samples.values, options.fit);
    if (fitted.fit.converged) fitted.characteristics = characteristicsOf(fitted.fit.parameters);
    addTemperatures(profile, matrix, fitted);
    assess(signal, profile.layout().matrix(matrix).taxelAreaMm2(), fitted);
    report.steps.push_back(std::move(fitted));
  }
  const bool touched = std::any_of(signal.values.begin(), signal.values.end(), [&](double v) {
    return v > options.steps.aboveCounts;
  });
  if (signal.values.empty())
    report.notes.push_back("the recording has no frames");
  else if (!touched)
    report.notes.push_back("no step: matrix " + std::to_string(matrix) + " is never loaded");
  else if (report.steps.empty())
    report.notes.push_back("no step: no contact of matrix " + std::to_string(matrix) + " lasts " +
                           fixedText(options.steps.minDurationS, 1) + " s and " +
                           std::to_string(options.steps.minFrames) + " frames");
  if (!report.steps.empty() && profile.numTemperatures() == 0)
    report.notes.push_back("no temperatures were recorded: K and m hold for an unknown one");
  return report;
}

Json jsonOf(const StepReport& report) {
  Json json = Json::object();
  json.set("matrix", report.matrix).set("signal", signalName(report.signal));
  json.set("steps",
           jsonList(report.steps, [](const FittedStep& fitted) { return jsonOf(fitted); }));
  json.set("notes", jsonList(report.notes));
  return json;
}

}  // namespace palpate

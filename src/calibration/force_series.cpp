#include "palpate/calibration/force_series.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"
#include "palpate/core/time.h"

namespace palpate {
namespace {

constexpr std::size_t kForceSeriesProgressEvery = 1024;  // frames

}  // namespace

MatrixForce matrixForce(const MatrixPressure& of) {
  constexpr int kMaximum = std::numeric_limits<std::uint16_t>::max();
  return {.staticResponseCounts = static_cast<float>(of.staticResponseCounts),
          .kpa = static_cast<float>(of.kpa),
          .sdKpa = static_cast<float>(of.sdKpa),
          .forceN = static_cast<float>(of.forceN),
          .sdForceN = static_cast<float>(of.sdForceN),
          .active = static_cast<std::uint16_t>(std::clamp(of.active, 0, kMaximum)),
          .inRange = of.inRange,
          .temperatureKnown = of.temperatureKnown,
          .saturated = of.saturated,
          .compensated = of.compensated,
          .startUnknown = of.startUnknown};
}

double ForceSeries::forceN(std::size_t frame) const {
  double sum = 0.0;
  for (std::size_t m = 0; m < numMatrices; ++m) sum += static_cast<double>(at(frame, m).forceN);
  return sum;
}

double ForceSeries::sdForceN(std::size_t frame) const {
  double sum = 0.0;
  for (std::size_t m = 0; m < numMatrices; ++m) sum += static_cast<double>(at(frame, m).sdForceN);
  return sum;
}

std::size_t ForceSeries::frameAt(double seconds) const {
  const auto after = std::upper_bound(timeS.begin(), timeS.end(), seconds);
  return after == timeS.begin() ? 0 : static_cast<std::size_t>(after - timeS.begin()) - 1;
}

ForceSeries forceSeries(const Profile& profile,
                        const Calibration& calibration,
                        const PressureMapOptions& options,
                        const std::optional<Tare>& tare,
                        const Progress& progress) {
  if (profile.info().valueType != ValueType::kCounts)
    throw Error("the recording holds filtered values: a calibration needs counts");
  PressureMapOptions used = options;
  used.serial = profile.info().serial;
  PressureMap map(calibration, profile.hand(), used);
  ForceSeries series;
  series.numMatrices = profile.layout().numMatrices();
  series.assumptions = map.assumptions();
  series.areaKnown = calibration.pressure.knowsArea();
  if (tare)
    series.assumptions.emplace_back("the zeros of the recording's tare event are taken off");
  if (profile.numTemperatures() == 0)
    series.assumptions.push_back(
        "no temperatures were recorded: " +
        std::to_string(static_cast<int>(calibration.pressure.options.assumedDegC)) +
        " °C assumed, and the band is wider");
  const std::size_t numFrames = profile.numFrames();
  series.timeS.reserve(numFrames);
  series.rows.reserve(numFrames * series.numMatrices);
  TactileFrame frame;
  PressureFrame pressures;
  std::optional<std::size_t> sample;
  std::vector<double> degC;
  for (std::size_t i = 0; i < numFrames; ++i) {
    reportProgress(progress, i, numFrames, kForceSeriesProgressEvery);
    profile.readFrame(i, frame);
    const auto belongs = profile.temperatureSampleAt(frame.hostUs);
    if (belongs && belongs != sample) degC = profile.temperatures(*belongs).values;
    sample = belongs;
    if (tare) applyTare(*tare, frame.values);
    map.apply(frame, degC, pressures);
    series.timeS.push_back(static_cast<double>(frame.hostUs - profile.frameTimeUs(0)) / kUsPerS);
    for (const MatrixPressure& matrix : pressures.matrices) {
      series.rows.push_back(matrixForce(matrix));
      if (matrix.active == 0) continue;
      ++series.contacts;
      series.beyond += matrix.inRange ? 0 : 1;
    }
  }
  std::size_t loadedFirst = 0;
  for (std::size_t m = 0; m < series.numMatrices && numFrames > 0; ++m)
    loadedFirst += series.at(0, m).startUnknown ? 1 : 0;
  if (loadedFirst > 0)
    series.assumptions.push_back(
        std::to_string(loadedFirst) + (loadedFirst == 1 ? " matrix was" : " matrices were") +
        " loaded in the first frame: how long before is not recorded, so creep counts from the "
        "first frame, and the forces of the same moment shown live may be lower");
  return series;
}

Json jsonOf(const SensorSettings& settings) {
  return Json::object()
      .set("sensitivity", settings.sensitivity)
      .set("threshold_counts", settings.thresholdCounts);
}

SensorSettings sensorSettingsFrom(const Json& json) {
  const Json sensitivity = json.at("sensitivity"), threshold = json.at("threshold_counts");
  if (!sensitivity.isNumber() || !(sensitivity.asDouble() > 0.0) || sensitivity.asDouble() > 1.0)
    throw Error("sensor settings: 'sensitivity' isn't in (0..1]");
  if (!threshold.isNumber() || !(threshold.asDouble() >= 0.0) ||
      !std::isfinite(threshold.asDouble()))
    throw Error("sensor settings: 'threshold_counts' is not 0 or above");
  return {sensitivity.asDouble(), threshold.asDouble(), true};
}

std::vector<SensorSettings> reportedSettingsFrom(const Json& json) {
  const Json rows = json.isArray() ? json : json.at("matrices");
  if (!rows.isArray()) throw Error("sensor settings: no array of matrices");
  std::vector<SensorSettings> settings;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    settings.push_back(sensorSettingsFrom(rows.at(i)));
    settings.back().assumed = false;
  }
  return settings;
}

void useReportedSettings(PressureMapOptions& options,
                         const std::string& metaSettings,
                         std::vector<ReportedChange> changes) {
  if (metaSettings.empty()) return;
  options.settings = reportedSettingsFrom(Json::parse(metaSettings));
  std::erase_if(changes, [](const ReportedChange& change) { return change.json.empty(); });
  std::stable_sort(changes.begin(), changes.end(), [](const auto& a, const auto& b) {
    return a.fromUs < b.fromUs;
  });
  for (const ReportedChange& change : changes)
    options.changes.push_back({change.fromUs, reportedSettingsFrom(Json::parse(change.json))});
}

}  // namespace palpate

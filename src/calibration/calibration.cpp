#include "palpate/calibration/calibration.h"

#include <cstdint>
#include <exception>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/text_file.h"

namespace palpate {
namespace {

constexpr const char* kKind = "palpate calibration";
constexpr std::uint64_t kMaxBytes = 16u << 20;

std::optional<double> numberIn(const Json& json, const char* key) {
  const Json value = json.at(key);
  return value.isNumber() ? std::optional(value.asDouble()) : std::nullopt;
}

std::string textIn(const Json& json, const char* key) {
  const Json value = json.at(key);
  return value.isString() ? value.asString() : std::string();
}

Json jsonOf(const PressureSample& sample) {
  Json notes = jsonList(sample.notes);
  return Json::object()
      .set("file", sample.file)
      .set("sha256", sample.sha256)
      .set("pressure_kpa", sample.pressureKpa)
      .set("K", sample.staticResponseCounts)
      .set("m", sample.driftCountsPerS)
      .set("temperature_c", orNull(sample.nearestDegC))
      .set("study_temperature_c", orNull(sample.studyDegC))
      .set("active_area_mm2", sample.activeAreaMm2)
      .set("duration_s", sample.durationS)
      .set("used", sample.used)
      .set("notes", std::move(notes));
}

PressureSample sampleFrom(const Json& json) {
  PressureSample sample;
  sample.file = textIn(json, "file");
  sample.sha256 = textIn(json, "sha256");
  const auto pressure = numberIn(json, "pressure_kpa");
  if (!pressure) throw Error("a sample lacks 'pressure_kpa'");
  sample.pressureKpa = *pressure;
  sample.staticResponseCounts = numberIn(json, "K").value_or(0.0);
  sample.driftCountsPerS = numberIn(json, "m").value_or(0.0);
  sample.nearestDegC = numberIn(json, "temperature_c");
  sample.studyDegC = numberIn(json, "study_temperature_c");
  sample.activeAreaMm2 = numberIn(json, "active_area_mm2").value_or(0.0);
  sample.durationS = numberIn(json, "duration_s").value_or(0.0);
  sample.used = json.at("used").isBool() && json.at("used").asBool();
  const Json notes = json.at("notes");
  for (std::size_t i = 0; i < notes.size(); ++i) sample.notes.push_back(notes.at(i).asString());
  return sample;
}

}  // namespace

Json jsonOf(const Calibration& calibration) {
  Json json = Json::object();
  json.set("kind", kKind).set("format_version", Calibration::kFormatVersion);
  json.set("program_version", calibration.programVersion).set("made_at", calibration.madeAt);
  json.set("hand", calibration.hand)
      .set("matrix", calibration.matrix)
      .set("signal", calibration.signal);
  if (!calibration.serial.empty()) json.set("serial", calibration.serial);
  json.set("settings",
           Json::object()
               .set("sensitivity", calibration.settings.sensitivity)
               .set("threshold_counts", calibration.settings.thresholdCounts)
               .set("assumed", calibration.settings.assumed));
  const Json model = jsonOf(calibration.pressure);
  for (const std::string& key : model.keys()) json.set(key, model.at(key));
  json.set("sensitivity_offset_counts", orNull(calibration.sensitivityOffset));
  if (calibration.noise) json.set("noise", jsonOf(*calibration.noise));
  json.set("options", calibration.options);
  Json samples =
      jsonList(calibration.samples, [](const PressureSample& sample) { return jsonOf(sample); });
  json.set("samples", std::move(samples));
  return json;
}

Calibration calibrationFrom(const Json& json) {
  if (textIn(json, "kind") != kKind)
    throw Error("isn't a calibration: 'kind' isn't \"palpate calibration\"");
  const auto version = numberIn(json, "format_version");
  if (!version) throw Error("lacks 'format_version'");
  if (*version > Calibration::kFormatVersion)
    throw Error("has a later format (" + std::to_string(static_cast<int>(*version)) +
                "): use a newer palpate");
  Calibration calibration;
  calibration.programVersion = textIn(json, "program_version");
  calibration.madeAt = textIn(json, "made_at");
  calibration.hand = textIn(json, "hand");
  calibration.serial = textIn(json, "serial");
  const auto matrix = numberIn(json, "matrix");
  if (!matrix || *matrix < 0 || *matrix > 1e6)
    throw Error("lacks 'matrix', the one it was measured on");
  calibration.matrix = static_cast<std::size_t>(*matrix);
  calibration.signal = textIn(json, "signal");
  const Json settings = json.at("settings");
  const auto sensitivity = numberIn(settings, "sensitivity"),
             threshold = numberIn(settings, "threshold_counts");
  if (!sensitivity || !threshold || !(*sensitivity > 0.0) || *sensitivity > 1.0 ||
      !(*threshold >= 0.0))
    throw Error("lacks 'settings' with a sensitivity (0..1] and a threshold");
  calibration.settings = {*sensitivity,
                          *threshold,
                          !settings.at("assumed").isBool() || settings.at("assumed").asBool()};
  calibration.pressure = pressureModelFrom(json);
  calibration.sensitivityOffset = numberIn(json, "sensitivity_offset_counts");
  if (json.at("noise").isObject()) calibration.noise = noiseFloorFrom(json.at("noise"));
  calibration.options = json.at("options");
  const Json samples = json.at("samples");
  for (std::size_t i = 0; i < samples.size(); ++i)
    calibration.samples.push_back(sampleFrom(samples.at(i)));
  return calibration;
}

Calibration loadCalibration(const std::filesystem::path& path) {
  const std::string text = readTextFile(path, kMaxBytes);
  try {
    return calibrationFrom(Json::parse(text));
  } catch (const FormatError&) {
    throw;
  } catch (const std::exception& error) {
    throw FormatError(path, error.what());
  }
}

void saveCalibration(const Calibration& calibration,
                     const std::filesystem::path& path,
                     Overwrite overwrite) {
  OutputFile file(path, overwrite);
  file.write(jsonOf(calibration).text() + "\n");
  file.commit();
}

}  // namespace palpate

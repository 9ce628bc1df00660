#include "commands/calibrated_frames.h"

#include <algorithm>
#include <set>
#include <utility>

#include "palpate/calibration/force_series.h"
#include "palpate/calibration/pressure_reader.h"
#include "palpate/core/error.h"
#include "palpate/recording/recording.h"

#include "commands/hand_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

// The tare of the last event "tare"; nothing when there is none.
std::optional<Tare> tareIn(const std::filesystem::path& file, const Recording& recording) {
  recording.requireEvents();
  std::optional<Tare> tare;
  for (const Event& event : recording.events)
    if (event.kind == "tare") try {
        tare = tareFrom(Json::parse(event.json), recording.profile.layout());
      } catch (const Error& error) {
        throw FileError(file,
                        std::string("its tare event can't be used (") + error.what() +
                            "); --no-tare leaves it out");
      }
  return tare;
}

// Adds the sensor settings of the recording when the command line has none: those that the window
// stored as an event, else those that the controller reported.
PressureMapOptions withSerial(PressureMapOptions options, const Profile& profile) {
  options.serial = profile.info().serial;
  return options;
}

PressureMapOptions withNoted(PressureMapOptions options,
                             const std::filesystem::path& file,
                             const Recording& recording) {
  if (!options.settings.empty()) return options;
  recording.requireEvents();
  // From the last event.
  std::optional<SensorSettings> noted;
  const std::vector<Event>& events = recording.events;
  for (const Event& event : events)
    if (event.kind == "sensor_settings") try {
        noted = sensorSettingsFrom(Json::parse(event.json));
      } catch (const Error& error) {
        throw FileError(file,
                        std::string("its sensor_settings event can't be used (") + error.what() +
                            "); give --sensor-sensitivity and --sensor-threshold instead");
      }
  if (noted) {
    options.settings.push_back(*noted);
    return options;
  }
  std::vector<ReportedChange> changes;
  for (const Event& event : events)
    if (event.kind == "settings") changes.push_back({event.t1Us, event.json});
  try {
    const auto reported = recording.meta.find("settings");
    useReportedSettings(
        options, reported == recording.meta.end() ? "" : reported->second, std::move(changes));
  } catch (const Error& error) {
    throw FileError(file,
                    std::string("the settings it reports can't be used (") + error.what() +
                        "); give --sensor-sensitivity and --sensor-threshold instead");
  }
  return options;
}

}  // namespace

std::vector<OptionSpec> calibrationOptions() {
  return {{"calibration", "C.json", "calibration that `palpate calibrate pressure` wrote"},
          ranged("sensor-sensitivity",
                 "S",
                 "sensitivity of the recording",
                 SensorSettings::kSensitivity,
                 "as stored in it, else that of the calibration"),
          ranged("sensor-threshold",
                 "N",
                 "threshold of the recording",
                 SensorSettings::kThresholdCounts,
                 "that of the calibration"),
          {"no-tare", "", "don't subtract the zeros that `calibrate tare --apply` noted"},
          {"no-drift", "", "don't correct the creep of long contacts"}};
}

std::vector<OptionSpec> withCalibration(std::vector<OptionSpec> options) {
  for (const OptionSpec& option : calibrationOptions()) options.push_back(option);
  return options;
}

std::optional<CalibrationChoice> calibrationGiven(const CommandLine& given) {
  const auto path = given.text("calibration");
  if (!path) {
    for (const char* option : {"sensor-sensitivity", "sensor-threshold", "no-tare", "no-drift"})
      if (given.has(option))
        throw UsageError("--" + std::string(option) + " needs --calibration C.json");
    return std::nullopt;
  }
  CalibrationChoice choice{loadCalibration(*path), {}, !given.has("no-tare")};
  if (!choice.calibration.pressure.valid())
    throw FileError(*path, "has no P(K, T), so it can't give forces; its notes say why");
  choice.options.compensateDrift = !given.has("no-drift");
  const auto sensitivity = given.number("sensor-sensitivity", SensorSettings::kSensitivity),
             threshold = given.number("sensor-threshold", SensorSettings::kThresholdCounts);
  if (sensitivity || threshold) {
    SensorSettings settings = choice.calibration.settings;
    settings.assumed = true;
    settings.sensitivity = sensitivity.value_or(settings.sensitivity);
    settings.thresholdCounts = threshold.value_or(settings.thresholdCounts);
    choice.options.settings.push_back(settings);
  }
  return choice;
}

ComputedOptions computedOptions(const std::optional<CalibrationChoice>& choice,
                                const std::filesystem::path& file,
                                const Recording& recording) {
  ComputedOptions options{.counts = recording.profile};
  if (!choice) return options;
  options.calibration = choice->calibration;
  options.pressure = withSerial(withNoted(choice->options, file, recording), recording.profile);
  if (choice->tare) options.tare = tareIn(file, recording);
  return options;
}

NamedSignals namedSignals(const std::optional<CalibrationChoice>& choice,
                          const std::filesystem::path& file,
                          const Recording& recording,
                          const Profile& frames) {
  ComputedOptions computed = computedOptions(choice, file, recording);
  return {withComputedSeries(frames, computed), std::move(computed)};
}

void reportAssumptions(const NamedSignals& named,
                       const std::vector<std::string>& names,
                       bool quiet) {
  const ComputedOptions& computed = named.computed;
  if (!computed.calibration) return;
  const bool unknown = !computed.calibration->pressure.knowsArea() &&
                       std::ranges::any_of(names, [](const std::string& name) {
                         return name.ends_with("_force_n");
                       });
  static std::set<std::string> printed;
  const PressureReader reader(
      *computed.counts, *computed.calibration, computed.pressure, computed.tare);
  for (const std::string& sentence : reader.assumptions()) {
    if (!printed.insert(sentence).second) continue;
    if (unknown && sentence == kUnknownAreaText)
      reportLoss(sentence);
    else if (!quiet)
      sayLine(sentence);
  }
}

CalibratedFrames::CalibratedFrames(const CalibrationChoice& choice,
                                   const std::filesystem::path& file,
                                   const Recording& recording,
                                   const Profile& profile)
    : profile_(profile),
      map_(choice.calibration,
           profile_.hand(),
           withSerial(withNoted(choice.options, file, recording), profile_)) {
  if (profile_.info().valueType != ValueType::kCounts)
    throw FileError(file,
                    "holds filtered values; a calibration needs counts: use the recording before "
                    "it was filtered");
  if (choice.tare) tare_ = tareIn(file, recording);
}

const PressureFrame& CalibratedFrames::of(const TactileFrame& frame) {
  std::vector<double> degC;
  if (const auto sample = profile_.temperatureSampleAt(frame.hostUs))
    degC = profile_.temperatures(*sample).values;
  if (tare_) {
    tared_ = frame;
    applyTare(*tare_, tared_.values);
  }
  map_.apply(tare_ ? tared_ : frame, degC, out_);
  return out_;
}

std::vector<std::string> CalibratedFrames::assumptions() const {
  std::vector<std::string> said = map_.assumptions();
  if (tare_) said.push_back("the zeros of the recording's tare event are taken off");
  if (profile_.numTemperatures() == 0)
    said.push_back(
        "no temperatures were recorded: " +
        std::to_string(static_cast<int>(map_.calibration().pressure.options.assumedDegC)) +
        " deg C assumed, and the band is wider");
  return said;
}

}  // namespace palpate::commands

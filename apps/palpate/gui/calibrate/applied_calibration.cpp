#include "gui/calibrate/applied_calibration.h"

#include <QFileInfo>

#include <palpate/core/error.h>
#include <palpate/core/text_file.h>

namespace palpate::gui {
namespace {

constexpr std::uint64_t kLargestNoiseFile = 16u << 20;  // [bytes]

QString appliedCalibrationKeyOf(const char* what, const std::string& hand) {
  return QString("calibrate/") + what + "/" + QString::fromStdString(hand).replace('/', '_');
}

}  // namespace

QString appliedCalibration(const QSettings& settings, const std::string& hand) {
  return settings.value(appliedCalibrationKeyOf("applied", hand)).toString();
}

void applyCalibration(QSettings& settings, const std::string& hand, const QString& path) {
  if (path.isEmpty())
    settings.remove(appliedCalibrationKeyOf("applied", hand));
  else
    settings.setValue(appliedCalibrationKeyOf("applied", hand), QFileInfo(path).absoluteFilePath());
}

std::optional<NoiseFloor> appliedNoise(const QSettings& settings, const std::string& hand) {
  const QString json = settings.value(appliedCalibrationKeyOf("noise", hand)).toString();
  if (json.isEmpty()) return std::nullopt;
  try {
    return noiseFloorFrom(Json::parse(json.toStdString()));
  } catch (const Error&) {
    // Written by a later version, or damaged: treated as not set.
    return std::nullopt;
  }
}

void applyNoise(QSettings& settings, const std::string& hand, const NoiseFloor& floor) {
  settings.setValue(appliedCalibrationKeyOf("noise", hand),
                    QString::fromStdString(jsonOf(floor).text(-1)));
}

NoiseFloor noiseFromFile(const QString& path) {
  const std::string name = path.toStdString();
  const std::string text = readTextFile(name, kLargestNoiseFile);
  if (path.endsWith(".xml", Qt::CaseInsensitive)) return parseNoiseXml(text, name);
  try {
    return noiseFloorFrom(Json::parse(text));
  } catch (const Error& error) {
    throw FormatError(name, std::string("holds no noise lines: ") + error.what());
  }
}

bool KeptWithRecording::operator==(const KeptWithRecording& other) const {
  const auto zeros = [](const KeptWithRecording& of) {
    return of.tare ? of.tare->zero : std::vector<float>();
  };
  const auto sameChange = [](const ReportedChange& a, const ReportedChange& b) {
    return a.fromUs == b.fromUs && a.json == b.json;
  };
  return settings == other.settings && problem == other.problem &&
         tare.has_value() == other.tare.has_value() && zeros(*this) == zeros(other) &&
         reportedSettings == other.reportedSettings &&
         std::equal(reportedChanges.begin(),
                    reportedChanges.end(),
                    other.reportedChanges.begin(),
                    other.reportedChanges.end(),
                    sameChange);
}

KeptWithRecording keptWith(const OpenedRecording& recording, const std::vector<Event>& events) {
  KeptWithRecording kept;
  const auto reportedSettings = recording.meta.find("settings");
  if (reportedSettings != recording.meta.end()) kept.reportedSettings = reportedSettings->second;
  for (const Event& event : events) try {
      if (event.kind == "tare")
        kept.tare = tareFrom(Json::parse(event.json), recording.profile.layout());
      if (event.kind == "sensor_settings")
        kept.settings = sensorSettingsFrom(Json::parse(event.json));
      if (event.kind == "settings") kept.reportedChanges.push_back({event.t1Us, event.json});
    } catch (const Error& error) {
      kept.problem = "An event \"" + QString::fromStdString(event.kind) +
                     "\" of the recording can't be used: " + error.what();
    }
  return kept;
}

PressureMapOptions pressureOptions(const KeptWithRecording& kept,
                                   const std::optional<SensorSettings>& typed) {
  PressureMapOptions options;
  if (const auto& said = typed ? typed : kept.settings)
    options.settings.push_back(*said);
  else
    useReportedSettings(options, kept.reportedSettings, kept.reportedChanges);
  return options;
}

Calibration usableCalibration(const QString& path) {
  Calibration calibration = loadCalibration(path.toStdString());
  if (!calibration.pressure.valid())
    throw Error(path.toStdString() +
                ": has no P(K, T), so forces can't be computed; its notes say why: open it on the "
                "page Pressure");
  return calibration;
}

}  // namespace palpate::gui

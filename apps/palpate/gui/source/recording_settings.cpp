#include "gui/source/recording_settings.h"

#include <QDir>
#include <QStandardPaths>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <unistd.h>

#include <palpate/capture/recording_name.h>
#include <palpate/core/error.h>

namespace palpate::gui {
namespace fs = std::filesystem;
namespace {

// [letters]; one row of the timeline has no room for more.
constexpr int kMostLabel = 60;
constexpr const char* kFolder = "recording/folder";
constexpr const char* kTemplate = "recording/template";
constexpr const char* kOperator = "recording/operator";
constexpr const char* kObject = "recording/object";
constexpr const char* kNotes = "recording/notes";
constexpr const char* kMcap = "recording/mcap";
constexpr const char* kStopAfter = "recording/stop_after_s";
constexpr const char* kSplitMinutes = "recording/split_min";
constexpr const char* kSplitMb = "recording/split_mb";
constexpr const char* kCountdown = "recording/countdown_s";
constexpr const char* kOnContact = "recording/start_on_contact";
constexpr const char* kReleased = "recording/stop_without_contact_s";
constexpr const char* kThreshold = "recording/contact_threshold";
constexpr const char* kAsk = "recording/ask";

QString labelKey(std::size_t digit) { return QString("recording/label%1").arg(digit); }

QString recordingSettingsTextOf(const QSettings& settings,
                                const QString& key,
                                const QString& otherwise) {
  const QString text = settings.value(key, otherwise).toString();
  return text.contains(QChar('\0')) ? otherwise : text;
}

// A number in the range; nothing: there is none, or one that makes no sense.
std::optional<double> recordingNumberOf(const QSettings& settings,
                                        const char* key,
                                        double least,
                                        double most) {
  bool isNumber = false;
  const double value = settings.value(key).toDouble(&isNumber);
  if (!isNumber || !(value >= least && value <= most)) return std::nullopt;
  return value;
}

void saveNumber(QSettings& settings, const char* key, const std::optional<double>& value) {
  if (value)
    settings.setValue(key, *value);
  else
    settings.remove(key);
}

RecordingNameFields fieldsOf(const RecordingSettings& recording, std::int64_t nowUs) {
  return {nowUs,
          recording.operatorName.toStdString(),
          recording.object.toStdString(),
          recording.run.toStdString()};
}

// Throws Error unless recordings can be written to `folder`, which may have to be created. Returns
// true when it doesn't exist yet.
bool checkFolder(const fs::path& folder) {
  if (folder.empty()) throw Error("choose a folder for recordings");
  if (!folder.is_absolute())
    throw FileError(folder, "isn't an absolute path; choose the folder with Browse");
  std::error_code failure;
  // The part of the path that exists.
  fs::path there = folder;
  while (!fs::exists(there, failure) && !failure && there.has_relative_path())
    there = there.parent_path();
  if (failure)
    throw FileError(there, "can't be read (" + failure.message() + "); choose another folder");
  if (!fs::is_directory(there, failure))
    throw FileError(there, "is a file, not a folder; choose another folder");
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    throw FileError(there, "you have no permission to write there; choose another folder");
  return there != folder;
}

// Turns a message of the library, which is meant for programmers ("RecordingName: {x} isn't known;
// .."), into one for the operator.
std::string inPlainWords(const std::invalid_argument& refusal) {
  std::string_view said = refusal.what();
  constexpr std::string_view kPrefix = "RecordingName: ";
  if (said.starts_with(kPrefix)) said.remove_prefix(kPrefix.size());
  return "the name: " + std::string(said);
}

fs::path folderOf(const RecordingSettings& recording) {
  return folderFromText(recording.folder).toStdString();
}

}  // namespace

QString defaultRecordingsFolder() {
  const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  return (documents.isEmpty() ? QDir::homePath() : documents) + "/Palpate recordings";
}

QString folderFromText(const QString& typed) {
  QString text = typed.trimmed();
  if (text == "~" || text.startsWith("~/")) text.replace(0, 1, QDir::homePath());
  return text.isEmpty() ? text : QDir::cleanPath(text);
}

RecordingSettings loadRecordingSettings(const QSettings& settings) {
  RecordingSettings recording;
  recording.folder = folderFromText(recordingSettingsTextOf(settings, kFolder, {}));
  if (!QDir::isAbsolutePath(recording.folder)) recording.folder = defaultRecordingsFolder();
  const QString nameTemplate =
      recordingSettingsTextOf(settings, kTemplate, recording.nameTemplate).trimmed();
  if (!nameTemplate.isEmpty()) recording.nameTemplate = nameTemplate;
  recording.operatorName = recordingSettingsTextOf(settings, kOperator, {});
  recording.object = recordingSettingsTextOf(settings, kObject, {});
  recording.notes = recordingSettingsTextOf(settings, kNotes, {});
  using Limits = RecordingLimits;
  recording.limits.stopAfterS =
      recordingNumberOf(settings, kStopAfter, Limits::kLeastStopS, Limits::kMostStopS);
  recording.limits.splitMinutes = recordingNumberOf(
      settings, kSplitMinutes, Limits::kLeastSplitMinutes, Limits::kMostSplitMinutes);
  recording.limits.splitMb =
      recordingNumberOf(settings, kSplitMb, Limits::kLeastSplitMb, Limits::kMostSplitMb);
  recording.countdownS = static_cast<int>(
      recordingNumberOf(settings, kCountdown, 0.0, RecordingSettings::kMostCountdownS)
          .value_or(0.0));
  recording.startOnContact = settings.value(kOnContact, false).toBool();
  recording.stopWithoutContactS =
      recordingNumberOf(settings, kReleased, kLeastReleasedS, kMostReleasedS);
  recording.contactThreshold =
      recordingNumberOf(settings, kThreshold, 0.0, kMostContactThreshold).value_or(0.0);
  recording.withMcap = settings.value(kMcap, false).toBool();
  recording.askEachTime = settings.value(kAsk, true).toBool();
  for (std::size_t digit = 0; digit < recording.markLabels.size(); ++digit) {
    QString& label = recording.markLabels[digit];
    label = recordingSettingsTextOf(settings, labelKey(digit), label).simplified().left(kMostLabel);
  }
  return recording;
}

void saveRecordingSettings(const RecordingSettings& recording, QSettings& settings) {
  settings.setValue(kFolder, recording.folder);
  settings.setValue(kTemplate, recording.nameTemplate);
  settings.setValue(kOperator, recording.operatorName);
  settings.setValue(kObject, recording.object);
  settings.setValue(kNotes, recording.notes);
  saveNumber(settings, kStopAfter, recording.limits.stopAfterS);
  saveNumber(settings, kSplitMinutes, recording.limits.splitMinutes);
  saveNumber(settings, kSplitMb, recording.limits.splitMb);
  settings.setValue(kCountdown, recording.countdownS);
  settings.setValue(kOnContact, recording.startOnContact);
  saveNumber(settings, kReleased, recording.stopWithoutContactS);
  settings.setValue(kThreshold, recording.contactThreshold);
  settings.setValue(kMcap, recording.withMcap);
  settings.setValue(kAsk, recording.askEachTime);
  for (std::size_t digit = 0; digit < recording.markLabels.size(); ++digit)
    settings.setValue(labelKey(digit), recording.markLabels[digit]);
}

fs::path nextPath(const RecordingSettings& recording, std::int64_t nowUs) {
  const fs::path folder = folderOf(recording);
  try {
    // Checks the template first, so that a wrong one leaves no empty folder behind.
    recordingFileName(recording.nameTemplate.toStdString(), fieldsOf(recording, nowUs), 1);
    if (checkFolder(folder)) {
      std::error_code failure;
      fs::create_directories(folder, failure);
      if (failure)
        throw FileError(folder,
                        "can't be created (" + failure.message() + "); choose another folder");
    }
    return nextRecordingPath(
        folder, recording.nameTemplate.toStdString(), fieldsOf(recording, nowUs));
  } catch (const std::invalid_argument& refusal) {
    throw Error(inPlainWords(refusal));
  }
}

RecordingOptions recordingOptions(const RecordingSettings& recording, const fs::path& path) {
  RecordingOptions options;
  options.path = path;
  const auto note = [&](const char* key, const QString& value) {
    if (!value.isEmpty()) options.meta[key] = value.toStdString();
  };
  note("operator", recording.operatorName);
  note("object", recording.object);
  note("notes", recording.notes);
  note("run", recording.run);
  note("repetition", recording.repetition);
  recording.limits.applyTo(options);
  options.startOnContact = recording.startOnContact;
  options.stopWithoutContactS = recording.stopWithoutContactS;
  options.contact.threshold = recording.contactThreshold;
  if (recording.withMcap) options.mcap.emplace();
  return options;
}

NextRecording previewNextPath(const RecordingSettings& recording, std::int64_t nowUs) {
  NextRecording next;
  const fs::path folder = folderOf(recording);
  const std::string nameTemplate = recording.nameTemplate.toStdString();
  const RecordingNameFields fields = fieldsOf(recording, nowUs);
  try {
    const std::string first = recordingFileName(nameTemplate, fields, 1);
    next.folderWillBeMade = checkFolder(folder);
    next.path =
        next.folderWillBeMade ? folder / first : nextRecordingPath(folder, nameTemplate, fields);
  } catch (const std::invalid_argument& refusal) {
    next.problem = QString::fromStdString(inPlainWords(refusal));
  } catch (const Error& error) {
    next.problem = QString::fromUtf8(error.what());
  }
  return next;
}

}  // namespace palpate::gui

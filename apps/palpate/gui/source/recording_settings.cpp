#include "gui/source/recording_settings.h"

#include <QDir>
#include <QStandardPaths>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <unistd.h>

#include <palpate/capture/recording_name.h>
#include <palpate/core/error.h>

#include "gui/appearance/settings_table.h"

namespace palpate::gui {
namespace fs = std::filesystem;
namespace {

// [letters]; one row of the timeline has no room for more.
constexpr int kMaxLabel = 60;
void recordingFields(SettingsTable& table, RecordingSettings& recording) {
  using Limits = RecordingLimits;
  Limits& limits = recording.limits;
  table.text("recording/folder", recording.folder);
  table.text("recording/template", recording.nameTemplate, [](const QString& text) {
    return !text.trimmed().isEmpty();
  });
  table.text("recording/operator", recording.operatorName);
  table.text("recording/object", recording.object);
  table.text("recording/notes", recording.notes);
  table.number("recording/stop_after_s",
               limits.stopAfterS,
               Limits::kStopAfterS.minimum,
               Limits::kStopAfterS.maximum);
  table.number("recording/split_min",
               limits.splitMinutes,
               Limits::kSplitMinutes.minimum,
               Limits::kSplitMinutes.maximum);
  table.number(
      "recording/split_mb", limits.splitMb, Limits::kSplitMb.minimum, Limits::kSplitMb.maximum);
  table.number(
      "recording/countdown_s", recording.countdownS, 0.0, RecordingSettings::kMaxCountdownS);
  table.flag("recording/start_on_contact", recording.startOnContact);
  table.number("recording/stop_without_contact_s",
               recording.stopWithoutContactS,
               kMinReleasedS,
               kMaxReleasedS);
  table.number(
      "recording/contact_threshold", recording.contactThreshold, 0.0, kMaxContactThreshold);
  table.flag("recording/mcap", recording.withMcap);
  table.flag("recording/ask", recording.askEachTime);
  for (std::size_t digit = 0; digit < recording.markLabels.size(); ++digit)
    table.text(QString("recording/label%1").arg(digit), recording.markLabels[digit]);
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
  auto recording = loadFields<RecordingSettings>(settings, recordingFields);
  recording.folder = folderFromText(recording.folder);
  if (!QDir::isAbsolutePath(recording.folder)) recording.folder = defaultRecordingsFolder();
  recording.nameTemplate = recording.nameTemplate.trimmed();
  for (QString& label : recording.markLabels) label = label.simplified().left(kMaxLabel);
  return recording;
}

void saveRecordingSettings(const RecordingSettings& recording, QSettings& settings) {
  saveFields(settings, recording, recordingFields);
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

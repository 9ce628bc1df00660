// What the operator says about the recordings of the day: who, what, where to, under which names.
#pragma once

#include <QSettings>
#include <QString>
#include <array>
#include <cstdint>
#include <filesystem>

#include <palpate/capture/recorder.h>

namespace palpate::gui {

struct RecordingSettings {
  QString folder;  // whole path; empty: nothing was chosen, nothing can be recorded
  QString nameTemplate = "{date}_{object}_{run}";  // capture/recording_name.h
  QString operatorName;
  QString object;
  QString notes;
  bool askEachTime = true;
  // Of the keys 0..9. An empty one leaves its key without a label.
  std::array<QString, 10> markLabels = {
      "start", "contact", "slip", "release", "lift", "place", "shake", "push", "drop", "wrong"};
};

// "Palpate recordings" in the user's folder of documents; isn't made before it is needed.
QString defaultRecordingsFolder();

// What was typed or chosen as a folder, as a whole path where it tells one: "~/runs/" is
// "/home/me/runs".
QString folderFromText(const QString& typed);

// A settings file never stops the program: what makes no sense there is replaced by the defaults.
RecordingSettings loadRecordingSettings(const QSettings& settings);
void saveRecordingSettings(const RecordingSettings& recording, QSettings& settings);

// The path of the next recording, which nothing has; makes the folder if it isn't there. `nowUs` is
// host time [us since 1970]. Throws Error, whose message is fit for the operator: no such
// placeholder, the folder can't be made or written.
std::filesystem::path nextPath(const RecordingSettings& recording, std::int64_t nowUs);

// The same without making anything, for a preview.
struct NextRecording {
  std::filesystem::path path;  // empty when there is a problem
  bool folderWillBeMade = false;
  QString problem;  // one line; empty: none
};
NextRecording previewNextPath(const RecordingSettings& recording, std::int64_t nowUs);

// A recording at `path` that says what the operator said.
RecordingOptions recordingOptions(const RecordingSettings& recording,
                                  const std::filesystem::path& path);

}  // namespace palpate::gui

// The operator's settings for new recordings: folder, names, operator, object, limits, labels; with
// the functions that build the path of the next recording from them.
#pragma once

#include <QSettings>
#include <QString>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

#include <palpate/capture/recorder.h>
#include <palpate/capture/recording_limits.h>

namespace palpate::gui {

struct RecordingSettings {
  // Absolute path; empty: none is chosen, and nothing can be recorded.
  QString folder;
  // Placeholders: see capture/recording_name.h.
  QString nameTemplate = "{date}_{object}_{run}";
  QString operatorName;
  QString object;
  QString notes;
  // Of one recording of a plan, and not kept: which run, and which of its repetitions ("2 of 3").
  QString run;
  QString repetition;
  // When it stops by itself, and goes on in a new file.
  RecordingLimits limits;
  // Seconds that are counted down before it begins, 0..kMaxCountdownS.
  static constexpr int kMaxCountdownS = 60;
  int countdownS = 0;
  // It begins with contact, and ends when nothing has been touched for a time [s]; a taxel touches
  // above the threshold, in the unit of the hand.
  bool startOnContact = false;
  std::optional<double> stopWithoutContactS;
  double contactThreshold = 0.0;
  bool withMcap = false;  // an MCAP file beside each recording
  bool askEachTime = true;
  // Labels of the keys 0..9. An empty text leaves its key without a label.
  std::array<QString, 10> markLabels = {
      "start", "contact", "slip", "release", "lift", "place", "shake", "push", "drop", "wrong"};
};

// "Palpate recordings" in the user's documents folder; it isn't created before it is needed.
QString defaultRecordingsFolder();

// Converts a typed folder into an absolute path where possible: "~/runs/" becomes "/home/me/runs".
QString folderFromText(const QString& typed);

// Values in the settings that make no sense are replaced by the defaults, so that a settings file
// never stops the program.
RecordingSettings loadRecordingSettings(const QSettings& settings);
// Ranges of stopWithoutContactS [s] and contactThreshold.
inline constexpr double kMinReleasedS = 0.05, kMaxReleasedS = 1e4, kMaxContactThreshold = 1e6;

void saveRecordingSettings(const RecordingSettings& recording, QSettings& settings);

// Returns the path of the next recording, at which no file exists; creates the folder if needed.
// `nowUs` is host time [us since 1970]. Throws Error with a message for the operator: unknown
// placeholder, or the folder can't be created or written.
std::filesystem::path nextPath(const RecordingSettings& recording, std::int64_t nowUs);

// The same without creating anything, for a preview.
struct NextRecording {
  // Empty when there is a problem.
  std::filesystem::path path;
  bool folderWillBeMade = false;
  // One line; empty: no problem.
  QString problem;
};
NextRecording previewNextPath(const RecordingSettings& recording, std::int64_t nowUs);

// Options of a recording at `path`, with the operator's settings.
RecordingOptions recordingOptions(const RecordingSettings& recording,
                                  const std::filesystem::path& path);

}  // namespace palpate::gui

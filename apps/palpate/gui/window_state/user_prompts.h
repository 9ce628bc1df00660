// The questions that the window asks the user; the feature that owns a question supplies its
// dialogue. Tests supply answers instead.
#pragma once

#include <QString>
#include <QStringList>
#include <functional>
#include <optional>

#include "gui/source/connection.h"
#include "gui/source/recording_settings.h"

namespace palpate::gui {

struct UserPrompts {
  // Asks for files to open; an empty list: cancelled.
  std::function<QStringList()> recordings;
  // Asks what to connect to; nothing: cancelled.
  std::function<std::optional<Connection>(const Connection& last)> connection;
  // Asks for name and settings of recordings, before one begins or in between; nothing: cancelled.
  std::function<std::optional<RecordingSettings>(const RecordingSettings&, const QString& button)>
      recording;
  // Asks whether the running recording may be ended now, and says what for (`ending`). If it can't
  // be written, offers another folder for what waits in memory.
  std::function<bool()> endRecording;
  // What ends the recording.
  enum class Ending { kDisconnect, kQuit, kStop };
  Ending ending = Ending::kDisconnect;
  // Asks for a folder; an empty answer: cancelled.
  std::function<QString(const QString& title, const QString& folder)> folder;
  // Asks before something is done that can't be undone; `button`: what is done ("Discard").
  std::function<bool(const QString& text, const QString& button)> confirmed;
  // Asks whether the plan of recordings is still followed, before its next recording begins.
  enum class Plan { kFollow, kLeave, kCancel };
  std::function<Plan(const QString& text)> plan;
  // Asks whether the running batch may be ended now.
  std::function<bool()> endBatch;
  // Asks for the text of a label or a note; nothing: cancelled. `title` is the title of the
  // dialogue, with the question in further lines; `text` is the present text.
  std::function<std::optional<QString>(const QString& title, const QString& text)> text;
  // Asks where to save a part of a recording; an empty answer: cancelled.
  std::function<QString(const QString& suggestion)> cropped;
  // Asks for a file to read or to write; an empty answer: cancelled. `filter` is that of
  // QFileDialog.
  std::function<QString(const QString& title, const QString& folder, const QString& filter)> file;
  std::function<QString(const QString& title, const QString& suggestion, const QString& filter)>
      newFile;
  // Asks whether to save unsaved labels.
  enum class Unsaved { kSave, kDiscard, kCancel };
  std::function<Unsaved(const QString& names)> unsaved;
};

}  // namespace palpate::gui

// What the window asks the user, each in a dialogue of the feature that wants to know. Tests answer
// themselves.
#pragma once

#include <QString>
#include <QStringList>
#include <functional>
#include <optional>

#include "gui/source/connection.h"
#include "gui/source/recording_settings.h"

namespace palpate::gui {

struct UserPrompts {
  // Files to open; none: cancelled.
  std::function<QStringList()> recordings;
  // Nothing: cancelled.
  std::function<std::optional<Connection>(const Connection& last)> connection;
  // What a recording shall be called, before it begins or in between; nothing: cancelled.
  std::function<std::optional<RecordingSettings>(const RecordingSettings&, const QString& button)>
      recording;
  // Whether a recording that runs may be ended now.
  std::function<bool()> endRecording;
  // The text of a label or a note; nothing: cancelled. `title` says which, `text` is what it is
  // now.
  std::function<std::optional<QString>(const QString& title, const QString& text)> text;
  // Where a part of a recording shall be saved; an empty answer means cancelled.
  std::function<QString(const QString& suggestion)> cropped;
  // Whether labels that aren't saved shall be.
  enum class Unsaved { kSave, kDiscard, kCancel };
  std::function<Unsaved(const QString& names)> unsaved;
};

}  // namespace palpate::gui

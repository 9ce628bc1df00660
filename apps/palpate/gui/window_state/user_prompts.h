// The questions that only one feature can ask, which supplies their dialogues; all others are
// asked by Ask. Tests supply answers instead.
#pragma once

#include <QString>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "gui/source/connection.h"
#include "gui/source/recording_settings.h"
#include "gui/source/sensor.h"

namespace palpate::gui {

struct UserPrompts {
  // Asks what to connect to; nothing: cancelled.
  std::function<std::optional<Connection>(const Connection& last)> connection;
  // Asks for a sensor to add to the hand; nothing: cancelled. The second one still reads its
  // source: whoever opens that releases it first, in another thread.
  std::function<std::optional<std::pair<Sensor, std::shared_ptr<void>>>()> sensor;
  // Asks for name and settings of recordings, before one begins or in between; nothing: cancelled.
  std::function<std::optional<RecordingSettings>(const RecordingSettings&, const QString& button)>
      recording;
  // What ends the recording.
  enum class Ending { kDisconnect, kQuit, kStop };
  // Asks whether the running recording may be ended now, and says what for. If it can't be
  // written, offers another folder for what waits in memory.
  std::function<bool(Ending)> endRecording;
};

}  // namespace palpate::gui

// Describes what the window connects to: a hand on its ports, the emulated hand, or the replay of a
// recording. The dialogue Connect edits it; LiveController opens it.
#pragma once

#include <QSettings>
#include <QString>
#include <array>

namespace palpate::gui {

struct Connection {
  enum class Kind { kPorts, kEmulated, kReplay };
  Kind kind = Kind::kEmulated;
  // For kPorts: addresses as openChannel() takes them. One of the two may be empty.
  // dsaPort is that of the tactile controller, sdhPort that of the motion controller.
  QString dsaPort = {};
  QString sdhPort = {};
  // For kEmulated: a name in data/scenes, or the path of a scene.
  QString scene = "ball";
  // Whether the script of the scene runs: the emulated hand grasps and releases by itself.
  bool sceneScriptRuns = false;
  // For kReplay: path of the recording.
  QString recording = {};
  bool operator==(const Connection&) const = default;
};
inline constexpr std::array kAllConnectionKinds = {
    Connection::Kind::kPorts, Connection::Kind::kEmulated, Connection::Kind::kReplay};

// "hand on ttyUSB0 and ttyUSB1", "emulated hand · ball", "replay of foam_ball.dsa"
QString describe(const Connection& connection);
// What is missing before the connection can be tried, one line; empty: nothing.
QString problemOf(const Connection& connection);

// Loads the last connection from the settings. Values that can't be read are replaced by the
// defaults.
Connection loadConnection(const QSettings& settings);
void saveConnection(const Connection& connection, QSettings& settings);

}  // namespace palpate::gui

// What the window is connected to, or shall be: a hand on its ports, the emulated hand, a
// recording.
#pragma once

#include <QSettings>
#include <QString>
#include <array>

namespace palpate::gui {

struct Connection {
  enum class Kind { kPorts, kEmulated, kReplay };
  Kind kind = Kind::kEmulated;
  // kPorts; as openChannel() takes them. Either one may be empty, not both.
  QString dsaPort = {};  // tactile controller
  QString sdhPort = {};  // motion controller
  // kEmulated: a name in data/scenes, or the path of a scene.
  QString scene = "ball";
  bool sceneScriptRuns = false;  // its script runs: the emulated hand grasps and lets go by itself
  // kReplay: path of the recording.
  QString recording = {};
  bool operator==(const Connection&) const = default;
};
inline constexpr std::array kAllConnectionKinds = {
    Connection::Kind::kPorts, Connection::Kind::kEmulated, Connection::Kind::kReplay};

// "hand on ttyUSB0 and ttyUSB1", "emulated hand · ball", "replay of foam_ball.dsa"
QString describe(const Connection& connection);
// What is missing before it can be tried, one line; empty: nothing.
QString problemOf(const Connection& connection);

// The connection that was made last. What can't be read is replaced by the defaults.
Connection loadConnection(const QSettings& settings);
void saveConnection(const Connection& connection, QSettings& settings);

}  // namespace palpate::gui

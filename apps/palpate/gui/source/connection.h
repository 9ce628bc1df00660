// Describes what the window connects to: a hand on its ports, a stream of frames, the emulated
// hand, or the replay of a recording. The dialogue Connect edits it; LiveController opens it.
#pragma once

#include <QSettings>
#include <QString>
#include <QStringList>
#include <array>
#include <optional>

#include <palpate/device/stream_device.h>

namespace palpate::gui {

// A stream of frames of any hand, which is read only.
struct StreamConnection {
  // As in StreamDeviceOptions::source, but never standard input.
  QString source = {};
  // As findHand() takes it: the name of a known hand, or a folder.
  QString hand = {};
  StreamFormat format = StreamFormat::kAuto;
  // Of lines of numbers.
  StreamTime time = StreamTime::kAuto;
  // Of a serial port [baud].
  int baud = 115'200;
  bool operator==(const StreamConnection&) const = default;
};

struct Connection {
  enum class Kind { kPorts, kStream, kEmulated, kReplay };
  Kind kind = Kind::kEmulated;
  // Under which the user has saved it; empty: it isn't a saved one.
  QString name = {};
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
  // For kStream.
  StreamConnection stream = {};
  bool operator==(const Connection&) const = default;
};
inline constexpr std::array kAllConnectionKinds = {Connection::Kind::kPorts,
                                                   Connection::Kind::kStream,
                                                   Connection::Kind::kEmulated,
                                                   Connection::Kind::kReplay};

// What the window calls a scene: "foam ball" for "foam_ball" and "/somewhere/foam_ball.json".
QString sceneTitle(const QString& scene);
// "hand on ttyUSB0 and ttyUSB1", "stream from ttyACM0 · my_pad", "emulated hand · ball", "replay of
// foam_ball.dsa"; of a saved connection "left hand: hand on ttyUSB0 and ttyUSB1".
QString describe(const Connection& connection);
// Whether both connect to the same source in the same way; the fields of other kinds, and the
// names, are ignored.
bool isSameSource(const Connection& a, const Connection& b);
// What is missing before the connection can be tried, one line; empty: nothing.
QString problemOf(const Connection& connection);

// Loads the last connection from the settings. Values that can't be read are replaced by the
// defaults.
Connection loadConnection(QSettings& settings);
// A connection has been made with these settings before.
bool hasLastConnection(QSettings& settings);
void saveConnection(const Connection& connection, QSettings& settings);
// The day of the last connection in the settings, as 2026-11-28.
inline constexpr const char* kLastConnectionDay = "window/connected_on";

// Connections that the user has saved under a name, in the order of the names. A name is any text
// but an empty one.
QStringList connectionNames(QSettings& settings);
// With its name. Nothing: there is none of this name.
std::optional<Connection> namedConnection(QSettings& settings, const QString& name);
// Replaces one of the same name.
void saveNamedConnection(QSettings& settings, const QString& name, const Connection& connection);
void removeNamedConnection(QSettings& settings, const QString& name);

}  // namespace palpate::gui

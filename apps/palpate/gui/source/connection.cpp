#include "gui/source/connection.h"

#include <QFileInfo>

namespace palpate::gui {
namespace {

constexpr const char* kConnectionKind = "connection/kind";
constexpr const char* kDsaPort = "connection/tactile_port";
constexpr const char* kSdhPort = "connection/motion_port";
constexpr const char* kScene = "connection/scene";
constexpr const char* kSceneActs = "connection/scene_acts";
constexpr const char* kRecording = "connection/recording";
constexpr const char* kStreamSource = "connection/stream_source";
constexpr const char* kStreamHand = "connection/stream_hand";
constexpr const char* kStreamFormat = "connection/stream_format";
constexpr const char* kStreamTime = "connection/stream_time";
constexpr const char* kStreamBaud = "connection/stream_baud";
// In the order of StreamFormat and StreamTime.
constexpr std::array kStreamFormats = {"auto", "lines", "json", "binary"};
constexpr std::array kStreamTimes = {"auto", "none", "s", "ms", "us"};

// The value whose name is stored; the first one when none is.
template <class Value, std::size_t kCount>
Value storedValue(const QSettings& settings,
                  const char* key,
                  const std::array<const char*, kCount>& names) {
  const QString name = settings.value(key).toString();
  for (std::size_t i = 0; i < kCount; ++i)
    if (name == names[i]) return static_cast<Value>(i);
  return Value{};
}

QString connectionKeyOf(Connection::Kind kind) {
  switch (kind) {
    case Connection::Kind::kPorts:
      return "ports";
    case Connection::Kind::kStream:
      return "stream";
    case Connection::Kind::kReplay:
      return "replay";
    case Connection::Kind::kEmulated:
      break;
  }
  return "emulated";
}

// A short name for a port: the last part of "/dev/ttyUSB0", the whole of "tcp:host:1". Long names
// (of /dev/serial/by-id) lose their middle.
QString connectionShortName(const QString& port) {
  constexpr int kLongest = 28;
  // Letters kept at either end.
  constexpr int kKept = 13;
  const QString name = port.startsWith('/') ? port.section('/', -1) : port;
  return name.size() <= kLongest ? name : name.left(kKept) + "…" + name.right(kKept);
}

}  // namespace

QString describe(const Connection& connection) {
  switch (connection.kind) {
    case Connection::Kind::kPorts: {
      QStringList ports;
      for (const QString& port : {connection.dsaPort, connection.sdhPort})
        if (!port.isEmpty()) ports.append(connectionShortName(port));
      return "hand on " + ports.join(" and ");
    }
    case Connection::Kind::kStream:
      return "stream from " + connectionShortName(connection.stream.source) + " · " +
             connectionShortName(connection.stream.hand);
    case Connection::Kind::kReplay:
      return "replay of " + QFileInfo(connection.recording).fileName();
    case Connection::Kind::kEmulated:
      break;
  }
  return "emulated hand · " + QFileInfo(connection.scene).completeBaseName();
}

QString problemOf(const Connection& connection) {
  switch (connection.kind) {
    case Connection::Kind::kPorts:
      if (connection.dsaPort.isEmpty() && connection.sdhPort.isEmpty())
        return "Choose the port of the tactile controller, of the motion controller, or both.";
      if (connection.dsaPort == connection.sdhPort)
        return "Tactile and motion controller need different ports.";
      return {};
    case Connection::Kind::kStream:
      if (connection.stream.source.isEmpty()) return "Choose where the stream comes from.";
      // Reading it would never end, and the window has none.
      if (connection.stream.source == "-") return "The window can't read standard input.";
      return connection.stream.hand.isEmpty() ? "Choose the hand whose frames are sent." : "";
    case Connection::Kind::kReplay:
      return connection.recording.isEmpty() ? "Choose a recording." : "";
    case Connection::Kind::kEmulated:
      break;
  }
  return connection.scene.isEmpty() ? "Choose a scene." : "";
}

Connection loadConnection(const QSettings& settings) {
  Connection connection;
  const QString kind = settings.value(kConnectionKind).toString();
  for (const Connection::Kind each : kAllConnectionKinds)
    if (connectionKeyOf(each) == kind) connection.kind = each;
  connection.dsaPort = settings.value(kDsaPort).toString();
  connection.sdhPort = settings.value(kSdhPort).toString();
  connection.scene = settings.value(kScene, connection.scene).toString();
  connection.sceneScriptRuns = settings.value(kSceneActs, connection.sceneScriptRuns).toBool();
  connection.recording = settings.value(kRecording).toString();
  StreamConnection& stream = connection.stream;
  stream.source = settings.value(kStreamSource).toString();
  stream.hand = settings.value(kStreamHand).toString();
  stream.format = storedValue<StreamFormat>(settings, kStreamFormat, kStreamFormats);
  stream.time = storedValue<StreamTime>(settings, kStreamTime, kStreamTimes);
  if (const int baud = settings.value(kStreamBaud).toInt(); baud > 0) stream.baud = baud;
  return connection;
}

void saveConnection(const Connection& connection, QSettings& settings) {
  settings.setValue(kConnectionKind, connectionKeyOf(connection.kind));
  settings.setValue(kDsaPort, connection.dsaPort);
  settings.setValue(kSdhPort, connection.sdhPort);
  settings.setValue(kScene, connection.scene);
  settings.setValue(kSceneActs, connection.sceneScriptRuns);
  settings.setValue(kRecording, connection.recording);
  const StreamConnection& stream = connection.stream;
  settings.setValue(kStreamSource, stream.source);
  settings.setValue(kStreamHand, stream.hand);
  settings.setValue(kStreamFormat, kStreamFormats[static_cast<std::size_t>(stream.format)]);
  settings.setValue(kStreamTime, kStreamTimes[static_cast<std::size_t>(stream.time)]);
  settings.setValue(kStreamBaud, stream.baud);
}

}  // namespace palpate::gui

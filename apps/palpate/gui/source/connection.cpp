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

QString connectionKeyOf(Connection::Kind kind) {
  switch (kind) {
    case Connection::Kind::kPorts:
      return "ports";
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
  return connection;
}

void saveConnection(const Connection& connection, QSettings& settings) {
  settings.setValue(kConnectionKind, connectionKeyOf(connection.kind));
  settings.setValue(kDsaPort, connection.dsaPort);
  settings.setValue(kSdhPort, connection.sdhPort);
  settings.setValue(kScene, connection.scene);
  settings.setValue(kSceneActs, connection.sceneScriptRuns);
  settings.setValue(kRecording, connection.recording);
}

}  // namespace palpate::gui

#include "gui/source/connection.h"

#include <QDate>
#include <QFileInfo>
#include <limits>

#include "gui/appearance/named_items.h"
#include "gui/appearance/settings_table.h"

namespace palpate::gui {
namespace {

// Groups of the settings: the last connection, and those with names.
constexpr const char* kLastConnection = "connection/";
constexpr const char* kNamedConnections = "connections/";
// In the order of Connection::Kind, StreamFormat and StreamTime.
constexpr std::array kConnectionKinds = {"ports", "stream", "emulated", "replay"};
constexpr std::array kStreamFormats = {"auto", "lines", "json", "binary"};
constexpr std::array kStreamTimes = {"auto", "none", "s", "ms", "us"};

void connectionFields(SettingsTable& table, Connection& connection) {
  StreamConnection& stream = connection.stream;
  table.choice("kind", connection.kind, kConnectionKinds);
  table.text("name", connection.name);
  table.text("tactile_port", connection.dsaPort);
  table.text("motion_port", connection.sdhPort);
  table.text("scene", connection.scene);
  table.flag("scene_acts", connection.sceneScriptRuns);
  table.text("recording", connection.recording);
  table.text("stream_source", stream.source);
  table.text("stream_hand", stream.hand);
  table.choice("stream_format", stream.format, kStreamFormats);
  table.choice("stream_time", stream.time, kStreamTimes);
  table.number("stream_baud", stream.baud, 1, std::numeric_limits<int>::max());
}

// Long names lose their middle.
QString withoutMiddle(const QString& name) {
  constexpr int kLongest = 28;
  // Letters kept at either end.
  constexpr int kKept = 13;
  return name.size() <= kLongest ? name : name.left(kKept) + "…" + name.right(kKept);
}

// A short name for a port: the last part of "/dev/ttyUSB0", the whole of "tcp:host:1"; without the
// middle of long names (of /dev/serial/by-id).
QString connectionShortName(const QString& port) {
  return withoutMiddle(port.startsWith('/') ? port.section('/', -1) : port);
}

QString connectionGroupOf(const QString& name) {
  return QString(kNamedConnections) + keyPartOf(name) + "/";
}

QString sourceText(const Connection& connection) {
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
  return "emulated hand · " + sceneTitle(connection.scene);
}

}  // namespace

QString sceneTitle(const QString& scene) {
  return QFileInfo(scene).completeBaseName().replace('_', ' ');
}

QString describe(const Connection& connection) {
  const QString source = sourceText(connection);
  if (connection.name.isEmpty() || connection.name == source) return source;
  return withoutMiddle(connection.name) + ": " + source;
}

bool isSameSource(const Connection& a, const Connection& b) {
  if (a.kind != b.kind) return false;
  switch (a.kind) {
    case Connection::Kind::kPorts:
      return a.dsaPort == b.dsaPort && a.sdhPort == b.sdhPort;
    case Connection::Kind::kStream:
      return a.stream == b.stream;
    case Connection::Kind::kReplay:
      return a.recording == b.recording;
    case Connection::Kind::kEmulated:
      break;
  }
  return a.scene == b.scene && a.sceneScriptRuns == b.sceneScriptRuns;
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

Connection loadConnection(QSettings& settings) {
  auto last = loadFields<Connection>(settings, connectionFields, kLastConnection);
  // The name may have been forgotten, or given to another hand, since.
  const auto named = namedConnection(settings, last.name);
  if (!named || !isSameSource(*named, last)) last.name.clear();
  return last;
}

bool hasLastConnection(QSettings& settings) {
  settings.beginGroup(kLastConnection);
  const bool has = !settings.childKeys().isEmpty();
  settings.endGroup();
  return has;
}

void saveConnection(const Connection& connection, QSettings& settings) {
  saveFields(settings, connection, connectionFields, kLastConnection);
  settings.setValue(kLastConnectionDay, QDate::currentDate().toString(Qt::ISODate));
}

QStringList connectionNames(QSettings& settings) {
  settings.beginGroup(kNamedConnections);
  const QStringList keys = settings.childGroups();
  settings.endGroup();
  return namesOfKeys(keys);
}

std::optional<Connection> namedConnection(QSettings& settings, const QString& name) {
  if (!connectionNames(settings).contains(name)) return std::nullopt;
  auto connection = loadFields<Connection>(settings, connectionFields, connectionGroupOf(name));
  connection.name = name;
  return connection;
}

void saveNamedConnection(QSettings& settings, const QString& name, const Connection& connection) {
  saveFields(settings, connection, connectionFields, connectionGroupOf(name));
}

void removeNamedConnection(QSettings& settings, const QString& name) {
  settings.remove(connectionGroupOf(name));
}

}  // namespace palpate::gui

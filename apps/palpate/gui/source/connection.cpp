#include "gui/source/connection.h"

#include <QFileInfo>
#include <QUrl>

namespace palpate::gui {
namespace {

// Groups of the settings: the last connection, and those with names.
constexpr const char* kLastConnection = "connection";
constexpr const char* kNamedConnections = "connections";
constexpr const char* kConnectionKind = "kind";
constexpr const char* kConnectionName = "name";
constexpr const char* kDsaPort = "tactile_port";
constexpr const char* kSdhPort = "motion_port";
constexpr const char* kScene = "scene";
constexpr const char* kSceneActs = "scene_acts";
constexpr const char* kRecording = "recording";
constexpr const char* kStreamSource = "stream_source";
constexpr const char* kStreamHand = "stream_hand";
constexpr const char* kStreamFormat = "stream_format";
constexpr const char* kStreamTime = "stream_time";
constexpr const char* kStreamBaud = "stream_baud";
// In the order of StreamFormat and StreamTime.
constexpr std::array kStreamFormats = {"auto", "lines", "json", "binary"};
constexpr std::array kStreamTimes = {"auto", "none", "s", "ms", "us"};

// The value whose name is stored; the first one when none is.
template <class Value, std::size_t kCount>
Value storedValue(const QSettings& settings,
                  const QString& key,
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

Connection connectionIn(const QSettings& settings, const QString& group) {
  const auto at = [&group](const char* key) { return group + "/" + key; };
  Connection connection;
  const QString kind = settings.value(at(kConnectionKind)).toString();
  for (const Connection::Kind each : kAllConnectionKinds)
    if (connectionKeyOf(each) == kind) connection.kind = each;
  connection.name = settings.value(at(kConnectionName)).toString();
  connection.dsaPort = settings.value(at(kDsaPort)).toString();
  connection.sdhPort = settings.value(at(kSdhPort)).toString();
  connection.scene = settings.value(at(kScene), connection.scene).toString();
  connection.sceneScriptRuns = settings.value(at(kSceneActs), connection.sceneScriptRuns).toBool();
  connection.recording = settings.value(at(kRecording)).toString();
  StreamConnection& stream = connection.stream;
  stream.source = settings.value(at(kStreamSource)).toString();
  stream.hand = settings.value(at(kStreamHand)).toString();
  stream.format = storedValue<StreamFormat>(settings, at(kStreamFormat), kStreamFormats);
  stream.time = storedValue<StreamTime>(settings, at(kStreamTime), kStreamTimes);
  if (const int baud = settings.value(at(kStreamBaud)).toInt(); baud > 0) stream.baud = baud;
  return connection;
}

void storeConnection(const Connection& connection, QSettings& settings, const QString& group) {
  const auto at = [&group](const char* key) { return group + "/" + key; };
  settings.setValue(at(kConnectionKind), connectionKeyOf(connection.kind));
  settings.setValue(at(kConnectionName), connection.name);
  settings.setValue(at(kDsaPort), connection.dsaPort);
  settings.setValue(at(kSdhPort), connection.sdhPort);
  settings.setValue(at(kScene), connection.scene);
  settings.setValue(at(kSceneActs), connection.sceneScriptRuns);
  settings.setValue(at(kRecording), connection.recording);
  const StreamConnection& stream = connection.stream;
  settings.setValue(at(kStreamSource), stream.source);
  settings.setValue(at(kStreamHand), stream.hand);
  settings.setValue(at(kStreamFormat), kStreamFormats[static_cast<std::size_t>(stream.format)]);
  settings.setValue(at(kStreamTime), kStreamTimes[static_cast<std::size_t>(stream.time)]);
  settings.setValue(at(kStreamBaud), stream.baud);
}

// Names of keys must not contain '/'.
QString connectionGroupOf(const QString& name) {
  return QString(kNamedConnections) + "/" + QString::fromLatin1(QUrl::toPercentEncoding(name));
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
  Connection last = connectionIn(settings, kLastConnection);
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
  storeConnection(connection, settings, kLastConnection);
}

QStringList connectionNames(QSettings& settings) {
  settings.beginGroup(kNamedConnections);
  const QStringList keys = settings.childGroups();
  settings.endGroup();
  QStringList names;
  for (const QString& key : keys) names << QUrl::fromPercentEncoding(key.toLatin1());
  names.sort(Qt::CaseInsensitive);
  return names;
}

std::optional<Connection> namedConnection(QSettings& settings, const QString& name) {
  if (!connectionNames(settings).contains(name)) return std::nullopt;
  Connection connection = connectionIn(settings, connectionGroupOf(name));
  connection.name = name;
  return connection;
}

void saveNamedConnection(QSettings& settings, const QString& name, const Connection& connection) {
  storeConnection(connection, settings, connectionGroupOf(name));
}

void removeNamedConnection(QSettings& settings, const QString& name) {
  settings.remove(connectionGroupOf(name));
}

}  // namespace palpate::gui

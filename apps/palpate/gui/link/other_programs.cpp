#include "gui/link/other_programs.h"

#include <QMetaObject>
#include <QPointer>

#include <palpate/core/error.h>

#include "gui/link/link_feature.h"

namespace palpate::gui {
namespace {

constexpr const char* kFoxgloveKey = "streams/foxglove";

const char* otherProgramsKeyOf(StreamKind kind) {
  return kind == StreamKind::kSignals ? "streams/signals" : "streams/tactile";
}

QString otherProgramsNameOf(StreamKind kind) {
  return kind == StreamKind::kSignals ? "signals (PlotJuggler)" : "taxels (TactileSensor)";
}

QString clientsText(std::size_t clients) {
  return clients == 1 ? QString("1 client") : QString::number(clients) + " clients";
}

}  // namespace

OtherPrograms::OtherPrograms(const OtherProgramsOptions& options, QObject* parent)
    : QObject(parent),
      actions_(options.actions),
      live_(options.live),
      settings_(options.settings),
      controller_(options.live, options.recordingSettings) {
  for (const StreamKind kind : kAllStreamKinds) {
    actionOf(kind)->setChecked(settings_.value(otherProgramsKeyOf(kind), false).toBool());
    connect(actionOf(kind), &QAction::toggled, this, [this, kind](bool on) {
      settings_.setValue(otherProgramsKeyOf(kind), on);
      switchStream(kind, on);
    });
  }
  actions_.streamFoxglove->setChecked(settings_.value(kFoxgloveKey, false).toBool());
  connect(actions_.streamFoxglove, &QAction::toggled, this, [this](bool on) {
    settings_.setValue(kFoxgloveKey, on);
    switchFoxglove(on);
  });
  connect(actions_.remoteControl, &QAction::toggled, this, &OtherPrograms::switchRemote);
  connect(&live_, &LiveController::sourceOpened, this, &OtherPrograms::useStreams);
  connect(&live_, &LiveController::ended, this, &OtherPrograms::changed);
  connect(&live_, &LiveController::refreshed, this, &OtherPrograms::changed);
}

QAction* OtherPrograms::actionOf(StreamKind kind) const {
  return kind == StreamKind::kSignals ? actions_.streamSignals : actions_.streamTactile;
}

std::uint16_t OtherPrograms::portOf(StreamKind kind) const {
  const int port =
      settings_.value(QString(otherProgramsKeyOf(kind)) + "_port", usualPort(kind)).toInt();
  return port >= 1 && port <= UINT16_MAX ? static_cast<std::uint16_t>(port) : usualPort(kind);
}

void OtherPrograms::useStreams() {
  for (const StreamKind kind : kAllStreamKinds)
    if (actionOf(kind)->isChecked()) switchStream(kind, true);
  if (actions_.streamFoxglove->isChecked()) switchFoxglove(true);
}

std::uint16_t OtherPrograms::foxglovePort() const {
  const int port = settings_.value("streams/foxglove_port", kUsualFoxglovePort).toInt();
  return port >= 1 && port <= UINT16_MAX ? static_cast<std::uint16_t>(port) : kUsualFoxglovePort;
}

void OtherPrograms::switchFoxglove(bool on) {
  LiveSource* source = live_.source();
  if (!source) return reportFoxglove(on);
  if (!on) {
    source->stream->switchOffFoxglove();
    return reportFoxglove(on);
  }
  try {
    FoxgloveOptions options;
    options.server.port = foxglovePort();
    for (const QString& origin : settings_.value("streams/foxglove_origins").toStringList())
      options.server.origins.push_back(origin.toStdString());
    // From the server's thread: the live controller, whose source has it, outlives it.
    options.server.onRefusedOrigin = [live = &live_,
                                      self = QPointer(this)](const std::string& why) {
      QMetaObject::invokeMethod(
          live,
          [self, why] {
            if (self) emit self->logged("Foxglove: " + QString::fromStdString(why));
          },
          Qt::QueuedConnection);
    };
    source->stream->switchOn(std::move(options));
  } catch (const Error& error) {
    actions_.streamFoxglove->setChecked(false);
    emit failed("Not streaming: " + QString::fromUtf8(error.what()));
    return;
  }
  reportFoxglove(on);
  if (const std::string problem = source->stream->geometryProblem(); !problem.empty())
    emit logged("Foxglove does not show the hand in 3-D: " + QString::fromStdString(problem));
}

void OtherPrograms::reportFoxglove(bool on) {
  emit logged(on ? "streaming to Foxglove at ws://127.0.0.1:" + QString::number(foxglovePort())
                 : QString("no longer streaming to Foxglove"));
  emit changed();
}

void OtherPrograms::switchStream(StreamKind kind, bool on) {
  if (LiveSource* source = live_.source()) {
    try {
      if (on)
        source->stream->switchOn(kind, portOf(kind));
      else
        source->stream->switchOff(kind);
    } catch (const Error& error) {
      actionOf(kind)->setChecked(false);
      emit failed("Not streaming: " + QString::fromUtf8(error.what()));
      return;
    }
  }
  emit logged(QString(on ? "streaming " : "no longer streaming ") + otherProgramsNameOf(kind) +
              (on ? " to 127.0.0.1:" + QString::number(portOf(kind)) : QString()));
  emit changed();
}

void OtherPrograms::switchRemote(bool on) {
  if (on == (server_ != nullptr)) return;
  if (!on) {
    server_.reset();
    emit logged("remote control is off");
    emit changed();
    return;
  }
  try {
    const QString named = actions_.remoteControl->data().toString();
    RemoteServerOptions options;
    options.onAnswer = [this](const RemoteRequest& request, const RemoteAnswer& answer) {
      QMetaObject::invokeMethod(
          this, [this, request, answer] { logRequest(request, answer); }, Qt::QueuedConnection);
    };
    server_ = std::make_unique<RemoteServer>(
        named.isEmpty() ? usualRemoteSocket() : std::filesystem::path(named.toStdString()),
        controller_,
        std::move(options));
  } catch (const Error& error) {
    actions_.remoteControl->setChecked(false);
    emit failed("No remote control: " + QString::fromUtf8(error.what()));
    return;
  }
  emit logged("remote control is on at " + QString::fromStdString(server_->socket().string()));
  emit changed();
}

void OtherPrograms::logRequest(const RemoteRequest& request, const RemoteAnswer& answer) {
  QString line =
      "remote control: " + QString::fromStdString(std::string(palpate::nameOf(request.verb)));
  if (!request.text.empty()) line += " " + QString::fromStdString(request.text);
  if (!answer.ok()) line += ": refused, " + QString::fromStdString(answer.message);
  emit logged(line);
  emit changed();
}

std::vector<Fact> OtherPrograms::facts() const {
  std::vector<Fact> facts;
  for (const StreamKind kind : kAllStreamKinds) {
    if (!actionOf(kind)->isChecked()) continue;
    std::optional<DatagramStats> stats;
    if (const LiveSource* source = live_.source()) stats = source->stream->stats(kind);
    QString value = "127.0.0.1:" + QString::number(portOf(kind));
    if (!stats)
      value += " · nothing is connected";
    else if (stats->sent + stats->dropped == 0)
      value += " · nothing sent yet";
    else
      value += stats->delivered ? " · " + QString::number(stats->sent) + " sent"
                                : QString(" · no receiver");
    facts.push_back({otherProgramsNameOf(kind), value});
  }
  if (actions_.streamFoxglove->isChecked()) {
    QString value = "ws://127.0.0.1:" + QString::number(foxglovePort());
    std::optional<FoxgloveServerStats> stats;
    if (const LiveSource* source = live_.source()) stats = source->stream->foxgloveStats();
    if (!stats)
      value += " · nothing is connected";
    else
      value += " · " + clientsText(stats->clients);
    if (stats && stats->dropped > 0) value += ", " + QString::number(stats->dropped) + " dropped";
    if (stats && !stats->lastRefusal.empty())
      value += " · refused: " + QString::fromStdString(stats->lastRefusal);
    facts.push_back({"Foxglove", value});
  }
  if (server_) {
    const std::size_t clients = server_->stats().clients;
    facts.push_back(
        {"remote control",
         QString::fromStdString(server_->socket().string()) + " · " + clientsText(clients)});
  }
  return facts;
}

QString OtherPrograms::shortText(const ActionRegistry& actions) {
  QStringList open;
  if (actions.at("streamSignals")->isChecked() || actions.at("streamTactile")->isChecked() ||
      actions.at("streamFoxglove")->isChecked())
    open.append("streaming");
  if (actions.at("remoteControl")->isChecked()) open.append("remote control");
  return open.join(", ");
}

}  // namespace palpate::gui

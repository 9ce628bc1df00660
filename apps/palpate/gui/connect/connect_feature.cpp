#include "gui/connect/connect_feature.h"

#include <QMenu>
#include <QMessageBox>

#include <palpate/emulator/scene.h>

#include "gui/connect/connect_dialog.h"
#include "gui/look/path_text.h"

namespace palpate::gui {

Connection emulatedBall(bool acts) {
  Connection ball;
  ball.kind = Connection::Kind::kEmulated;
  ball.scene = "ball";
  ball.sceneActs = acts;
  return ball;
}

ConnectFeature::ConnectFeature(Bench& bench, QWidget* window)
    : Feature(bench, window), actions_(bench.actions) {
  addQuestions();
  connectActions();
  LiveController& live = bench.live;
  connect(&live, &LiveController::came, this, [&bench, &live] {
    saveConnection(live.source()->connection, bench.settings);
  });
  connect(&live, &LiveController::stateChanged, this, [&bench] { bench.enabling.refresh(); });
  connect(&bench.moment, &Moment::firstFrameCame, this, [&bench] { bench.enabling.refresh(); });
  connect(&bench.moment, &Moment::heldChanged, this, [this, &bench] {
    actions_.hold->setChecked(bench.moment.held());
  });
  connect(bench.menus.connections, &QMenu::aboutToShow, this, &ConnectFeature::fillMenu);
  bench.escape.add(Escape::Order::kConnecting, [&live] {
    if (live.state() != LiveController::State::kConnecting) return false;
    live.end();
    return true;
  });
}

std::filesystem::path ConnectFeature::scenesFolder() const {
  return bench().surroundings.dataFolder / "scenes";
}

void ConnectFeature::addQuestions() {
  Bench& bench = this->bench();
  bench.questions.connection = [this, &bench](const Connection& last) -> std::optional<Connection> {
    PortScan scan;
    // What is connected now answers us, not a probe.
    const Connection& now = bench.live.connection();
    if (bench.live.source() && now.kind == Connection::Kind::kPorts)
      scan.setBusy({now.dsaPort, now.sdhPort},
                   knownAnswers(now, bench.live.source()->session->device().status()));
    ConnectDialog dialog({.last = last,
                          .scenesFolder = scenesFolder(),
                          .recentRecordings = bench.recent.paths(),
                          .theme = bench.look.theme()},
                         scan,
                         window());
    if (dialog.exec() != QDialog::Accepted) return std::nullopt;
    return dialog.connection();
  };
  bench.questions.endRecording = [this] {
    return QMessageBox::question(window(),
                                 "Palpate",
                                 "A recording is running. Finish it and go on?",
                                 QMessageBox::Yes | QMessageBox::Cancel,
                                 QMessageBox::Yes) == QMessageBox::Yes;
  };
}

void ConnectFeature::connectActions() {
  Bench& bench = this->bench();
  ConnectActions& actions = actions_;
  on(actions.connectHand, [&bench] {
    if (const auto wanted = bench.questions.connection(loadConnection(bench.settings)))
      bench.connectTo(*wanted);
  });
  on(actions.tryEmulated, [&bench] { bench.connectTo(emulatedBall(false)); });
  on(actions.disconnectHand, [&bench] {
    if (!bench.live.recording() || bench.questions.endRecording()) bench.live.end();
  });
  on(actions.live, [this, &bench] {
    bench.subject.showLive();
    bench.enabling.refresh();
    actions_.live->setChecked(bench.subject.isLive());
  });
  on(actions.hold, [&bench](bool held) { bench.moment.hold(held); });
  connect(&bench.subject, &Subject::shown, this, [this, &bench] {
    actions_.live->setChecked(bench.subject.isLive());
    bench.enabling.refresh();
  });
  bench.enabling.add({actions.disconnectHand},
                     [&bench] { return bench.live.state() != LiveController::State::kNone; });
  bench.enabling.add({actions.live}, [&bench] { return bench.live.source() != nullptr; });
  bench.enabling.add({actions.hold}, [&bench] { return bench.subject.isLive(); });
}

// The last one first, then every scene, then what needs a dialogue.
void ConnectFeature::fillMenu() {
  Bench& bench = this->bench();
  QMenu* menu = bench.menus.connections;
  menu->clear();
  const auto add = [this, &bench](QMenu* to, QString text, const Connection& connection) {
    connect(
        to->addAction(text.replace('&', "&&")), &QAction::triggered, this, [&bench, connection] {
          bench.connectTo(connection);
        });
  };
  const Connection last = loadConnection(bench.settings);
  if (problemOf(last).isEmpty()) add(menu, "Again: " + describe(last), last);
  menu->addAction(actions_.connectHand);
  menu->addSeparator();
  QMenu* scenes = menu->addMenu("&Emulated hand");
  for (const std::string& name : sceneNames(scenesFolder())) {
    Connection connection;
    connection.kind = Connection::Kind::kEmulated;
    connection.scene = QString::fromStdString(name);
    add(scenes, QString(connection.scene).replace('_', ' '), connection);
  }
  QMenu* replays = menu->addMenu("&Replay of a recording");
  const auto replay = [&](const QString& path) {
    Connection connection;
    connection.kind = Connection::Kind::kReplay;
    connection.recording = path;
    add(replays, path.section('/', -1), connection);
  };
  for (const QString& path : bench.recent.paths())
    if (RecentFiles::exists(path)) replay(path);
  if (bench.actions.at("openDemo")->isEnabled()) replay(pathText(bench.demoRecording()));
  if (replays->isEmpty()) replays->addAction("no recent recording")->setEnabled(false);
  menu->addSeparator();
  menu->addAction(actions_.disconnectHand);
}

}  // namespace palpate::gui

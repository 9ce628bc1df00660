#include "gui/connect/connect_feature.h"

#include <QFileInfo>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QStandardPaths>
#include <algorithm>

#include <palpate/core/number_text.h>
#include <palpate/emulator/scene.h>
#include <palpate/model/hand_file.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/icons.h"
#include "gui/connect/connect_dialog.h"
#include "gui/connect/sensor_dialog.h"
#include "gui/desktop/ask.h"

namespace palpate::gui {

ConnectActions::ConnectActions(ActionRegistry& book) {
  connectHand = book.make("connectHand", "Hand", "&Connect…", {key("Ctrl+K")});
  tryEmulated = book.make("tryEmulated", "Hand", "Try the &emulated hand");
  addSensor = book.make("addSensor", "Hand", "Add a sensor…");
  addSensor->setToolTip("Record the rows of another sensor along with the hand");
  disconnectHand = book.make("disconnectHand", "Hand", "&Disconnect");
  live = book.make("live", "Hand", "Show &live", {key("F6")}, true);
  live->setToolTip("Show the connected hand (F6)");
  hold = book.make("hold", "Hand", "&Hold the live picture", {key("P")}, true);
  live->setIconText(" Live");
  connectHand->setIconText(" " + plainText(*connectHand));
  connectHand->setIcon(makeIcon(IconShape::kConnect));
  live->setIcon(makeIcon(IconShape::kLive));
}

Connection emulatedBallConnection() {
  Connection ball;
  ball.kind = Connection::Kind::kEmulated;
  ball.scene = "ball";
  ball.sceneScriptRuns = true;
  return ball;
}

namespace {

// What the end of the recording is for: "Before the program quits".
QString endingText(UserPrompts::Ending ending) {
  return ending == UserPrompts::Ending::kQuit
             ? "Before the program quits and the hand is disconnected"
             : "Before the hand is disconnected";
}

QString handEndText(const std::optional<GraspStatus>& hand) {
  if (!hand) return {};
  return hand->phase == GraspPhase::kHolding
             ? " The hand keeps holding, but no longer answers slips."
             : " The hand is moving: it will be stopped.";
}

}  // namespace

QString endRecordingText(const RecorderStatus& recorder,
                         const std::optional<GraspStatus>& hand,
                         UserPrompts::Ending ending) {
  const bool contact = recorder.state == RecorderStatus::State::kArmed;
  const QString what =
      contact || recorder.state == RecorderStatus::State::kWaiting
          ? QString("A recording waits for ") + (contact ? "contact. " : "the first frame. ") +
                endingText(ending) + ", it is cancelled: there is nothing to keep yet."
          : "A recording is running. " + endingText(ending) +
                ", the recording is finished; all that was recorded is kept.";
  return what + handEndText(hand);
}

ConnectFeature::ConnectFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window), actions_(windowState.actions) {
  addQuestions();
  connectActions();
  connectSensors();
  LiveController& live = windowState.live;
  connect(&live, &LiveController::sourceOpened, this, [&windowState, &live] {
    saveConnection(live.source()->connection, windowState.settings);
  });
  connect(&live, &LiveController::stateChanged, this, [&windowState] {
    windowState.actionEnabler.refresh();
  });
  connect(&windowState.currentFrame, &CurrentFrame::firstFrameReceived, this, [&windowState] {
    windowState.actionEnabler.refresh();
  });
  connect(&windowState.currentFrame, &CurrentFrame::heldChanged, this, [this, &windowState] {
    actions_.hold->setChecked(windowState.currentFrame.held());
  });
  connect(windowState.menus.connections, &QMenu::aboutToShow, this, &ConnectFeature::fillMenu);
  windowState.escapeHandler.add(EscapeHandler::Order::kConnecting, [&live] {
    if (live.state() != LiveController::State::kConnecting) return false;
    live.end();
    return true;
  });
}

std::filesystem::path ConnectFeature::scenesFolder() const {
  return state().environment.dataFolder / "scenes";
}

void ConnectFeature::addQuestions() {
  WindowState& windowState = state();
  windowState.prompts.connection =
      [this, &windowState](const Connection& last) -> std::optional<Connection> {
    PortScan scan;
    // The current connection gives the answers for its own ports, not a probe.
    const Connection& now = windowState.live.connection();
    if (windowState.live.source() && now.kind == Connection::Kind::kPorts)
      scan.setBusy({now.dsaPort, now.sdhPort},
                   knownProbes(now, windowState.live.source()->session->device().status()));
    ConnectDialog dialog({.last = last,
                          .scenesFolder = scenesFolder(),
                          .handFolders = handFolders(windowState.environment.dataFolder),
                          .recentRecordings = windowState.recent.paths(),
                          .settings = &windowState.settings},
                         scan,
                         windowState.ask,
                         window());
    if (dialog.exec() != QDialog::Accepted) return std::nullopt;
    return dialog.connection();
  };
  windowState.prompts.sensor = [this]() -> std::optional<std::pair<Sensor, std::shared_ptr<void>>> {
    PortScan scan;
    QStringList taken = sensorNames();
    taken << "angles"
          << "temperatures"
          << "tactile"
          << "events";
    Sensor proposal{.name = "sensor"};
    for (int i = 2; taken.contains(proposal.name); ++i)
      proposal.name = "sensor_" + QString::number(i);
    SensorDialog dialog(proposal, taken, scan, window());
    if (dialog.exec() != QDialog::Accepted) return std::nullopt;
    return std::pair(dialog.sensor(), dialog.takePreview());
  };
  windowState.prompts.endRecording = [this](UserPrompts::Ending ending) {
    return mayEndRecording(ending);
  };
}

std::optional<GraspStatus> ConnectFeature::movingHand() const {
  const LiveSource* source = state().live.source();
  if (!source || !source->control) return std::nullopt;
  GraspStatus status = source->control->status();
  return status.request ? std::optional(std::move(status)) : std::nullopt;
}

bool ConnectFeature::mayEndRecording(UserPrompts::Ending ending) {
  WindowState& windowState = state();
  const auto moving = ending == UserPrompts::Ending::kStop ? std::nullopt : movingHand();
  const RecorderStatus& recorder = windowState.live.health().recorder;
  QMessageBox question(
      QMessageBox::NoIcon, "Finish the recording", {}, QMessageBox::NoButton, window());
  const QPushButton* elsewhere = nullptr;
  if (recorder.writeError.empty()) {
    question.setText(endRecordingText(recorder, moving, ending));
  } else {
    const std::int64_t waiting = recorder.frames - recorder.framesOnDisk;
    question.setText("The recording can't be written: " +
                     QString::fromStdString(counted(
                         static_cast<std::uint64_t>(std::max<std::int64_t>(0, waiting)), "frame")) +
                     (waiting == 1 ? " waits" : " wait") +
                     " in memory. Finishing it here loses them; in another folder they are kept." +
                     handEndText(moving));
    question.setInformativeText(QString::fromStdString(recorder.writeError));
    elsewhere = question.addButton("Another folder…", QMessageBox::AcceptRole);
  }
  const QPushButton* finish =
      question.addButton(elsewhere ? "Finish without them" : "Finish the recording",
                         elsewhere ? QMessageBox::DestructiveRole : QMessageBox::AcceptRole);
  QPushButton* keep = question.addButton("Keep recording", QMessageBox::RejectRole);
  question.setEscapeButton(keep);
  question.exec();
  if (elsewhere && question.clickedButton() == elsewhere) return moveRecording();
  return question.clickedButton() == finish;
}

// Asks for another folder until one can be written; false: cancelled.
bool ConnectFeature::moveRecording() {
  WindowState& windowState = state();
  const QString home = QStandardPaths::writableLocation(QStandardPaths::HomeLocation);
  const QString folder = windowState.ask.folder("Another folder for the recording", home);
  if (folder.isEmpty()) return false;
  if (!QFileInfo(folder).isDir() || !QFileInfo(folder).isWritable()) {
    windowState.messages.fail(folder + " can't be written: choose another folder");
    return false;
  }
  windowState.live.continueRecordingIn(folder.toStdString());
  return true;
}

void ConnectFeature::disconnectHand() {
  LiveController& live = state().live;
  const bool connected = live.source() != nullptr;
  const auto moving = movingHand();
  live.end();
  if (!connected) return;
  state().messages.flash(!moving ? "Disconnected"
                         : moving->cannotMove.empty()
                             ? "Disconnected; the hand is sent a stop"
                             : "Disconnected; the hand can't be stopped from here: use the "
                               "emergency stop if it moves");
}

void ConnectFeature::connectActions() {
  WindowState& windowState = state();
  ConnectActions& actions = actions_;
  on(actions.connectHand, [&windowState] {
    if (const auto wanted = windowState.prompts.connection(loadConnection(windowState.settings)))
      windowState.connectTo(*wanted);
  });
  on(actions.tryEmulated, [&windowState] {
    windowState.connectTo(emulatedBallConnection());
    windowState.messages.flash(
        "An emulated hand grasps a ball by itself. Press Grasp, Open or Stop to take over.");
  });
  on(actions.disconnectHand, [this, &windowState] {
    if (!windowState.live.recording() ||
        windowState.prompts.endRecording(UserPrompts::Ending::kDisconnect))
      disconnectHand();
  });
  on(actions.live, [this, &windowState] {
    windowState.displayed.showLive();
    windowState.actionEnabler.refresh();
    actions_.live->setChecked(windowState.displayed.isLive());
  });
  on(actions.hold, [&windowState](bool held) { windowState.currentFrame.hold(held); });
  connect(&windowState.displayed, &DisplayedSource::shown, this, [this, &windowState] {
    actions_.live->setChecked(windowState.displayed.isLive());
    windowState.actionEnabler.refresh();
  });
  windowState.actionEnabler.add(
      {actions.disconnectHand},
      [&windowState] { return windowState.live.state() != LiveController::State::kNone; },
      "No hand is connected");
  windowState.actionEnabler.add({actions.live},
                                [&windowState] { return windowState.live.source() != nullptr; });
  windowState.actionEnabler.add({actions.hold},
                                [&windowState] { return windowState.displayed.isLive(); });
}

void ConnectFeature::connectSensors() {
  WindowState& windowState = state();
  LiveController& live = windowState.live;
  // The times of a replay are not those of a sensor.
  const auto takesSensors = [&live] {
    return live.source() && live.connection().kind != Connection::Kind::kReplay;
  };
  windowState.actionEnabler.add(
      {actions_.addSensor}, takesSensors, "No hand is connected, or a recording is replayed");
  on(actions_.addSensor, [this, &windowState] {
    if (auto wanted = windowState.prompts.sensor())
      addSensor(wanted->first, std::move(wanted->second));
  });
  connect(&live, &LiveController::sourceReady, this, [this, &windowState, takesSensors] {
    if (!takesSensors()) return;
    for (const Sensor& sensor : rememberedSensors(windowState.settings)) addSensor(sensor);
  });
  connect(&live, &LiveController::sensorsFailed, this, [&windowState](const QString& message) {
    windowState.messages.fail(message);
  });
}

void ConnectFeature::addSensor(const Sensor& sensor, std::shared_ptr<void> preview) {
  state().live.changeSensors(
      [sensor, held = std::make_shared<std::shared_ptr<void>>(std::move(preview))](
          CaptureSession& session) {
        held->reset();  // the port must be free
        session.addSeries(std::make_unique<SeriesSource>(optionsOf(sensor)));
      },
      [this, sensor] {
        rememberSensor(sensor, state().settings);
        state().messages.flash("The sensor " + sensor.name + " was added: see the dock Link");
      });
}

void ConnectFeature::removeSensor(const QString& name) {
  state().live.changeSensors(
      [series = name.toStdString()](CaptureSession& session) { session.removeSeries(series); },
      [this, name] {
        forgetSensor(name, state().settings);
        state().messages.flash("The sensor " + name + " was removed");
      });
}

QStringList ConnectFeature::sensorNames() const {
  QStringList names;
  if (const LiveSource* source = state().live.source())
    for (const auto& each : source->session->seriesSources())
      names << QString::fromStdString(each->name());
  return names;
}

// Fills the menu: the last connection first, then every scene, then the entries that open the
// dialog.
void ConnectFeature::fillMenu() {
  WindowState& windowState = state();
  QMenu* menu = windowState.menus.connections;
  menu->clear();
  const auto add = [this, &windowState](QMenu* to, QString text, const Connection& connection) {
    connect(to->addAction(text.replace('&', "&&")),
            &QAction::triggered,
            this,
            [&windowState, connection] { windowState.connectTo(connection); });
  };
  const Connection last = loadConnection(windowState.settings);
  if (hasLastConnection(windowState.settings) && problemOf(last).isEmpty())
    add(menu, "Again: " + describe(last), last);
  for (const QString& name : connectionNames(windowState.settings))
    if (const auto saved = namedConnection(windowState.settings, name)) add(menu, name, *saved);
  menu->addAction(actions_.connectHand);
  menu->addSeparator();
  QMenu* scenes = menu->addMenu("&Emulated hand");
  for (const std::string& name : sceneNames(scenesFolder())) {
    Connection connection;
    connection.kind = Connection::Kind::kEmulated;
    connection.scene = QString::fromStdString(name);
    connection.sceneScriptRuns = true;  // else nothing pulls or turns the object
    add(scenes, sceneTitle(connection.scene), connection);
  }
  QMenu* replays = menu->addMenu("&Replay of a recording");
  const auto replay = [&](const QString& path) {
    Connection connection;
    connection.kind = Connection::Kind::kReplay;
    connection.recording = path;
    add(replays, path.section('/', -1), connection);
  };
  for (const QString& path : windowState.recent.paths())
    if (!windowState.recent.isMissing(path)) replay(path);
  if (windowState.actions.at("openDemo")->isEnabled())
    replay(pathText(windowState.demoRecording()));
  if (replays->isEmpty()) replays->addAction("no recent recording")->setEnabled(false);
  menu->addSeparator();
  menu->addAction(actions_.addSensor);
  if (const QStringList names = sensorNames(); !names.isEmpty()) {
    QMenu* remove = menu->addMenu("Remove a sensor");
    for (const QString& name : names)
      connect(
          remove->addAction(name), &QAction::triggered, this, [this, name] { removeSensor(name); });
  }
  menu->addSeparator();
  menu->addAction(actions_.disconnectHand);
}

}  // namespace palpate::gui

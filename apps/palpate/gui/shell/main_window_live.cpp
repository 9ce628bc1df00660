// The main window on what is connected: a hand, the emulated hand, a replay.
#include <QApplication>
#include <QMenu>
#include <QMessageBox>
#include <algorithm>

#include <palpate/capture/link_health.h>
#include <palpate/emulator/scene.h>

#include "gui/connect/connect_dialog.h"
#include "gui/hand/hand_dock.h"
#include "gui/inspect/inspect_panel.h"
#include "gui/link/link_panel.h"
#include "gui/look/captions.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/record/other_programs.h"
#include "gui/shell/main_window_calibrate.h"
#include "gui/shell/main_window_slip.h"
#include "gui/space/hand_panel.h"
#include "gui/timeline/live_chart.h"
#include "gui/widgets/message_banner.h"
#include "gui/widgets/offer_strip.h"
#include "gui/widgets/status_strip.h"

namespace palpate::gui {
namespace {

std::vector<Fact> mainWindowLiveFactsOf(const Connection& connection,
                                        const DeviceFacts& device,
                                        const QString& hand,
                                        const QString& calibration) {
  std::vector<Fact> facts{{"source", describe(connection)}, {"hand", hand}};
  const auto add = [&](const QString& name, const std::string& value) {
    if (!value.empty()) facts.push_back({name, QString::fromStdString(value)});
  };
  add("serial", device.serial);
  add("tactile firmware", device.firmware);
  add("motion firmware", device.motionFirmware);
  facts.push_back({"calibration", calibration});
  return facts;
}

// It lives as long as `live`.
void connectOtherPrograms(const Actions& actions,
                          LiveController& live,
                          QSettings& settings,
                          LinkPanel& link,
                          MessageBanner& banner,
                          std::function<RecordingSettings()> recordingSettings) {
  auto* others = new OtherPrograms({actions, live, settings, std::move(recordingSettings)}, &live);
  QObject::connect(others, &OtherPrograms::changed, &link, [others, &link] {
    link.showOtherPrograms(others->facts());
  });
  QObject::connect(others, &OtherPrograms::logged, &link, &LinkPanel::log);
  QObject::connect(others, &OtherPrograms::failed, &banner, [&banner, &link](const QString& why) {
    banner.showMessage(why);
    link.log(why);
  });
  link.showOtherPrograms(others->facts());
}

}  // namespace

MatricesView& MainWindow::matricesView() { return matrices_->view(); }

void MainWindow::connectLive() {
  askForConnection = [this](const Connection& last) -> std::optional<Connection> {
    PortScan scan;
    // What is connected now answers us, not a probe.
    const Connection& now = live_.connection();
    if (live_.source() && now.kind == Connection::Kind::kPorts)
      scan.setBusy({now.dsaPort, now.sdhPort},
                   knownAnswers(now, live_.source()->session->device().status()));
    ConnectDialog dialog({.last = last,
                          .scenesFolder = demoPath_.parent_path() / "scenes",
                          .recentRecordings = recent_.paths(),
                          .theme = resolved(view_.theme)},
                         scan,
                         this);
    if (dialog.exec() != QDialog::Accepted) return std::nullopt;
    return dialog.connection();
  };
  askToEndRecording = [this] {
    return QMessageBox::question(this,
                                 "Palpate",
                                 "A recording is running. Finish it and go on?",
                                 QMessageBox::Yes | QMessageBox::Cancel,
                                 QMessageBox::Yes) == QMessageBox::Yes;
  };
  connect(&live_, &LiveController::came, this, &MainWindow::liveCame);
  connect(&live_, &LiveController::leaving, this, &MainWindow::liveLeaving);
  connect(&live_, &LiveController::ended, this, &MainWindow::liveEnded);
  connect(&live_, &LiveController::failed, this, [this](const QString& message) {
    banner_->showMessage(message);
    link_->log("not connected: " + message);
  });
  connect(&live_, &LiveController::stateChanged, this, [this] {
    enableActions();
    showLook();
    updateStatus();
  });
  connect(&live_, &LiveController::frameCame, this, [this](const TactileFrame& frame) {
    if (!liveShown_ || held_ || filteredShown()) return;
    const bool first = matrices_->frame().values.empty();
    matrices_->showLive(frame);
    if (first) enableActions();
  });
  connect(&live_, &LiveController::resultsCame, this, [this](const LiveResults& results) {
    if (!liveShown_ || held_) return;
    if (filteredShown()) {
      const bool first = matrices_->frame().values.empty();
      matrices_->showLive(*results.frame);
      if (first) enableActions();
    }
    inspect_->showLive(results);
    calibrate_->showLive(results);
    slip_->showLive(results);
    if (!handPanel_->isHidden())
      handPanel_->showLive(*results.frame,
                           results.angles ? results.angles->deg : std::vector<double>());
    liveChart_->refresh(0.0);
  });
  connect(&live_, &LiveController::staleChanged, this, &MainWindow::showStale);
  connect(&live_, &LiveController::looked, this, &MainWindow::showLook);
  connect(
      &live_, &LiveController::eventsCame, this, [this](const std::vector<RecordingEvent>& events) {
        for (const RecordingEvent& event : events) {
          link_->addEvent(event);
          liveChart_->addEvent(event);
        }
      });
  connect(&bell_, &AlarmBell::changed, this, [this](const QStringList& alarms) {
    link_->showAlarms(alarms);
    // Closed by the user it stays closed until something new is wrong.
    if (alarms.isEmpty() || alarmIsNew_ || !alarmStrip_->isHidden()) alarmStrip_->showAll(alarms);
    alarmIsNew_ = false;
  });
  connect(&bell_, &AlarmBell::raised, this, [this](const QString& text) {
    alarmIsNew_ = true;
    link_->log("alarm: " + text);
    QApplication::alert(this);
  });
  const auto mute = [this](bool muted) {
    bell_.setMuted(muted);
    link_->setMuted(muted);
    actions_.muteAlarms->setChecked(muted);
    settings_.setValue("alarms/muted", muted);
  };
  connect(link_, &LinkPanel::mutedChanged, this, mute);
  connect(actions_.muteAlarms, &QAction::triggered, this, mute);
  mute(settings_.value("alarms/muted", false).toBool());

  const auto on = [this](QAction* action, auto what) {
    connect(action, &QAction::triggered, this, what);
  };
  on(actions_.connectHand, [this] { askAndConnect(); });
  on(actions_.tryEmulated, [this] { tryEmulatedHand(); });
  on(actions_.disconnectHand, [this] {
    if (!live_.recording() || askToEndRecording()) live_.end();
  });
  on(actions_.live, [this] { showLive(); });
  on(actions_.hold, [this](bool held) {
    held_ = held;
    liveChart_->setHeld(held);
    showStale();
    updateStatus();
  });
  connect(menus_->connections, &QMenu::aboutToShow, this, &MainWindow::fillConnections);
  const double windowS = settings_.value("live/window_s", LiveChart::kUsualS).toDouble();
  liveChart_->setWindowS(windowS);
  connect(liveChart_, &LiveChart::windowChanged, this, [this](double seconds) {
    settings_.setValue("live/window_s", seconds);
  });
  hand_->bind(actions_);
  connect(hand_, &HandDock::blindChanged, this, [this](const std::vector<QString>& why) {
    if (liveShown_ || why.empty()) matrices_->view().setBlind(why);
  });
  connectScanActions();
  connectOtherPrograms(
      actions_, live_, settings_, *link_, *banner_, [this] { return recordingSettings_; });
}

void MainWindow::connectTo(const Connection& connection) {
  if (live_.recording() && !askToEndRecording()) return;
  banner_->dismiss();
  live_.connectTo(connection);
}

void MainWindow::askAndConnect() {
  if (const auto wanted = askForConnection(loadConnection(settings_))) connectTo(*wanted);
}

void MainWindow::tryEmulatedHand() {
  Connection ball;
  ball.kind = Connection::Kind::kEmulated;
  ball.scene = "ball";
  connectTo(ball);
}

void MainWindow::openDemo() {
  Connection ball;
  ball.kind = Connection::Kind::kEmulated;
  ball.scene = "ball";
  ball.sceneActs = true;
  connectTo(ball);
}

// The last one first, then every scene, then what needs a dialogue.
void MainWindow::fillConnections() {
  QMenu* menu = menus_->connections;
  menu->clear();
  const Connection last = loadConnection(settings_);
  if (problemOf(last).isEmpty())
    connect(menu->addAction("Again: " + describe(last).replace('&', "&&")),
            &QAction::triggered,
            this,
            [this, last] { connectTo(last); });
  menu->addAction(actions_.connectHand);
  menu->addSeparator();
  QMenu* scenes = menu->addMenu("&Emulated hand");
  for (const std::string& name : sceneNames(demoPath_.parent_path() / "scenes")) {
    Connection connection;
    connection.kind = Connection::Kind::kEmulated;
    connection.scene = QString::fromStdString(name);
    connect(scenes->addAction(QString(connection.scene).replace('_', ' ')),
            &QAction::triggered,
            this,
            [this, connection] { connectTo(connection); });
  }
  QMenu* replays = menu->addMenu("&Replay of a recording");
  const auto replay = [&](const QString& path) {
    Connection connection;
    connection.kind = Connection::Kind::kReplay;
    connection.recording = path;
    QString name = path.section('/', -1);
    connect(
        replays->addAction(name.replace('&', "&&")), &QAction::triggered, this, [this, connection] {
          connectTo(connection);
        });
  };
  for (const QString& path : recent_.paths())
    if (RecentFiles::exists(path)) replay(path);
  if (actions_.openDemo->isEnabled()) replay(QString::fromStdString(demoPath_.string()));
  if (replays->isEmpty()) replays->addAction("no recent recording")->setEnabled(false);
  menu->addSeparator();
  menu->addAction(actions_.disconnectHand);
}

void MainWindow::liveCame() {
  LiveSource& source = *live_.source();
  saveConnection(source.connection, settings_);
  hand_->setHand(source.session.get(), source.control.get());
  link_->log("connected: " + describe(source.connection));
  showLive();
}

void MainWindow::liveLeaving() {
  hand_->setHand(nullptr, nullptr);
  liveChart_->setHistory(nullptr, 0);
  link_->clear();
  bell_.hear({}, 0);
  link_->log("disconnected: " + describe(live_.connection()));
  shownHistory_ = nullptr;
  scanAnswers_.clear();
  if (liveShown_) setPictureOld({"not connected any more"});
}

void MainWindow::liveEnded() {
  if (closing_) {
    close();
    return;
  }
  if (live_.state() != LiveController::State::kNone) return;
  menus_->showLink({}, false);
  if (!liveShown_) return enableActions();
  liveShown_ = false;
  held_ = false;
  actions_.hold->setChecked(false);
  setPictureOld({});
  const OpenedRecordingPtr recording = current_;
  current_.reset();
  showRecording(recording);
}

void MainWindow::showLive() {
  LiveSource* source = live_.source();
  if (!source) return;
  const bool another = source->history.get() != shownHistory_;
  const bool newly = !liveShown_ || another;
  playback_.pause();
  if (!liveShown_) noteWhereWeAre();
  liveShown_ = true;
  showCompare(false);
  setPlace(Place::kLive);
  if (newly) {
    const HandDescription hand = source->session->device().hand();
    shownHistory_ = source->history.get();
    matrices_->setRecording(nullptr);
    inspect_->setHand(hand);
    showHand(hand);
    if (another) liveChart_->setHistory(source->history.get(), hand.layout->numMatrices());
    held_ = false;
    liveChart_->setHeld(false);
    actions_.hold->setChecked(false);
  }
  setWindowTitle(describe(source->connection) + " – Palpate");
  if (newly) filterNewSource();
  showStale();
  showPlotted();
  enableActions();
  showLook();
}

void MainWindow::showHand(const HandDescription& hand) {
  matrices_->setHand(hand);
  matrices_->view().setBlind(hand_->blind());
  handPanel_->setHand(hand);
  inspect_->renewHand(hand);
  slip_->renewHand(hand);
}

void MainWindow::showStale() {
  if (!liveShown_) return;
  QString notice;
  if (live_.source() && live_.source()->finished()) {
    notice = "the replay has ended";
  } else if (live_.stale()) {
    const PortStatus& port = live_.health().device.tactile;
    notice = !live_.framesCameYet() ? QString("waiting for the first frame")
                                    : "no frame for " + figure(live_.silentS(), 1) + " s";
    if (!port.message.empty()) notice += ": " + QString::fromStdString(withoutPort(port));
  }
  if (held_) notice = notice.isEmpty() ? QString(kHeldText) : kHeldText + ("; " + notice);
  inspect_->table().setOld(!notice.isEmpty());
  setPictureOld({notice, held_});
}

void MainWindow::setPictureOld(const OldPicture& old) {
  matrices_->view().setOld(old);
  handPanel_->view().setOld(old);
}

// Four times a second: everything but the frames.
void MainWindow::showLook() {
  LiveSource* source = live_.source();
  if (!source) {
    menus_->showLink(live_.state() == LiveController::State::kConnecting ? "connecting …" : "",
                     false);
    menus_->showRecording(false);
    return;
  }
  const LinkHealth& health = live_.health();
  const bool finished = source->finished();
  bell_.hear(finished ? std::vector<Alarm>() : health.alarms, systemClock().monotonicUs());
  link_->showHealth(health, live_.beforeRun());
  menus_->showLink(describe(source->connection) +
                       (finished        ? " · ended"
                        : live_.stale() ? " · no data"
                                        : " · " + figure(health.frames.rateHz, 1) + " fps"),
                   !live_.stale());
  showRecordingState();
  showLiveFilter();
  heedScanAnswers();
  if (!liveShown_) return;
  const HandDescription hand = source->session->device().hand();
  inspect_->setLiveFacts(mainWindowLiveFactsOf(source->connection,
                                               source->session->device().facts(),
                                               QString::fromStdString(hand.name),
                                               calibrate_->text()));
  // Other taxels are scanned now, or another hand was found.
  if (matrices_->hand() && !(*matrices_->hand()->layout == *hand.layout)) showHand(hand);
  if (live_.stale()) {
    showStale();
    if (!held_ && live_.framesCameYet() && !finished) liveChart_->refresh(live_.silentS());
  }
  updateStatus();
}

void MainWindow::updateLiveStatus() {
  Status now;
  const LinkHealth& health = live_.health();
  now.lamp = live_.stale() || held_ ? Status::Lamp::kWarning : Status::Lamp::kGood;
  const RecorderStatus& recorder = health.recorder;
  if (live_.source() && live_.source()->finished())
    now.state = "the replay has ended";
  else if (live_.stale())
    now.state = live_.framesCameYet() ? "no data" : "waiting for data";
  else if (recorder.state != RecorderStatus::State::kIdle)
    now.state =
        recorder.framesOnDisk >= recorder.frames
            ? "all frames on disk"
            : "frames to write: " + QString::number(recorder.frames - recorder.framesOnDisk);
  else
    now.state = "live";
  if (held_) now.state = "held (P goes on) · " + now.state;
  now.figures = {
      "rate " + figure(health.frames.rateHz, 1) + " fps",
      "age " + (live_.stale() ? QString("–") : figure(health.device.tactile.ageMs, 0)) + " ms",
      "lost " + QString::number(health.lost),
      "bad " + QString::number(health.badChecksums),
      "saturated " + QString::number(health.frames.saturatedFrames)};
  now.notice = noticeNow();
  now.right = describe(live_.connection());
  if (const QString open = OtherPrograms::shortText(actions_); !open.isEmpty())
    now.right = open + " · " + now.right;
  status_->setStatus(now);
}

}  // namespace palpate::gui

#include "gui/link/link_feature.h"

#include <QApplication>
#include <string>
#include <vector>

#include <palpate/core/escaped_line.h>

#include "gui/link/link_panel.h"
#include "gui/widgets/dock.h"
#include "gui/widgets/message_banner.h"

namespace palpate::gui {

LinkActions::LinkActions(ActionRegistry& book) {
  muteAlarms = book.make("muteAlarms", "Hand", "Mute alar&ms", {key("Ctrl+Shift+M")}, true);
  streamSignals = book.make("streamSignals", "Hand", "Stream signals to &PlotJuggler", {}, true);
  streamSignals->setToolTip("A datagram of JSON per frame, to this machine only");
  streamTactile =
      book.make("streamTactile", "Hand", "Stream all &taxels (ROS TactileSensor)", {}, true);
  streamTactile->setToolTip("A datagram of JSON per frame, to this machine only");
  streamFoxglove = book.make("streamFoxglove", "Hand", "Show the hand in &Foxglove", {}, true);
  streamFoxglove->setToolTip("A WebSocket for Foxglove, on this machine only");
  remoteControl = book.make("remoteControl", "Hand", "&Remote control", {}, true);
  remoteControl->setToolTip("Your programs can start, stop and label recordings");
}

namespace {

constexpr const char* kMutedKey = "alarms/muted";

QString handAlarmOf(const LiveSource& source) {
  return source.control ? handAlarm(source.control->status(), source.session->nowUs()) : QString();
}

}  // namespace

LinkFeature::LinkFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      actions_(windowState.actions),
      panel_(new LinkPanel(window)),
      alarms_(new MessageBanner(window, "AlarmStrip", "alarm")) {
  dock_ = new Dock("Link", panel_, nullptr, window);
  connectLog();
  connectAlarms();
  connectOthers();
  connect(&windowState.live, &LiveController::refreshed, this, &LinkFeature::look);
  connect(&windowState.derivedResults,
          &DerivedResults::unmeasurableChanged,
          panel_,
          // The panel may outlive this feature.
          [panel = panel_, &windowState] {
            panel->setUnmeasurable(windowState.derivedResults.unmeasurable());
          });
  connect(&windowState.live,
          &LiveController::eventsReceived,
          this,
          [this](const std::vector<Event>& events) {
            for (const Event& event : events) panel_->addEvent(event);
          });
}

// Called after connectLog(), so that the log reports the connection before its streams.
void LinkFeature::connectOthers() {
  WindowState& windowState = state();
  others_ = std::make_unique<OtherPrograms>(
      OtherProgramsOptions{actions_,
                           windowState.live,
                           windowState.settings,
                           [&windowState] { return loadRecordingSettings(windowState.settings); }},
      nullptr);
  connect(others_.get(), &OtherPrograms::changed, panel_, [this] {
    panel_->showOtherPrograms(others_->facts());
  });
  connect(others_.get(), &OtherPrograms::logged, panel_, &LinkPanel::log);
  connect(others_.get(), &OtherPrograms::failed, panel_, [this](const QString& why) {
    this->state().messages.fail(why);
    panel_->log(why);
  });
  panel_->showOtherPrograms(others_->facts());
}

void LinkFeature::connectLog() {
  LiveController& live = state().live;
  connect(&state().messages, &Messages::linkLogged, panel_, &LinkPanel::log);
  connect(panel_, &LinkPanel::logged, this, [this](const QString& line) {
    // Does not log what the banner has just logged.
    ActivityLog& log = state().log;
    const int last = log.rowCount() - 1;
    if (last >= 0 && line.contains(log.line(last).text)) return;
    log.add(line.startsWith("alarm") ? LogLine::Severity::kWarning : LogLine::Severity::kInfo,
            line);
  });
  connect(&live, &LiveController::sourceOpened, this, [this, &live] {
    noticeLogged_ = false;
    remarksLogged_ = 0;
    panel_->log("connected: " + describe(live.source()->connection));
  });
  connect(&live, &LiveController::failed, this, [this](const QString& message) {
    state().messages.fail(message);
    panel_->log("not connected: " + message);
  });
  connect(&live, &LiveController::leaving, this, [this, &live] {
    panel_->clear();
    alarmNotifier_.updateAlarms({}, 0);
    panel_->log("disconnected: " + describe(live.connection()));
  });
}

void LinkFeature::connectAlarms() {
  connect(&alarmNotifier_, &AlarmNotifier::changed, this, [this](const QStringList& alarms) {
    panel_->showAlarms(alarms);
    // When the user has closed the banner, it stays closed until a new alarm appears.
    if (alarms.isEmpty() || alarmIsNew_ || !alarms_->isHidden()) alarms_->showAll(alarms);
    alarmIsNew_ = false;
  });
  connect(&alarmNotifier_, &AlarmNotifier::raised, this, [this](const QString& text) {
    alarmIsNew_ = true;
    panel_->log("alarm: " + text);
    QApplication::alert(window());
  });
  connect(panel_, &LinkPanel::mutedChanged, this, &LinkFeature::mute);
  on(actions_.muteAlarms, [this](bool muted) { mute(muted); });
  mute(state().settings.value(kMutedKey, false).toBool());
  state().escapeHandler.add(EscapeHandler::Order::kAlarm, [this] {
    const LiveSource* source = state().live.source();
    // A hand that is not protected is acknowledged, not passed over, nor is one that moves.
    if (alarms_->isHidden() || (source && !handAlarmOf(*source).isEmpty())) return false;
    alarms_->hide();
    return true;
  });
}

void LinkFeature::mute(bool muted) {
  alarmNotifier_.setMuted(muted);
  panel_->setMuted(muted);
  actions_.muteAlarms->setChecked(muted);
  state().settings.setValue(kMutedKey, muted);
}

// Called four times a second.
void LinkFeature::look() {
  LiveController& live = state().live;
  LiveSource* source = live.source();
  if (!source) return;
  const LinkHealth& health = live.health();
  alarmNotifier_.updateAlarms(source->finished() ? std::vector<Alarm>() : health.alarms,
                              systemClock().monotonicUs(),
                              handAlarmOf(*source));
  const StreamDevice* stream = source->streamDevice();
  std::vector<Fact> facts = stream ? factsOf(*stream) : std::vector<Fact>();
  for (const auto& sensor : source->session->seriesSources())
    for (Fact& fact : factsOf(*sensor)) facts.push_back(std::move(fact));
  panel_->showHealth(health, live.preflight(), facts);
  if (stream && !noticeLogged_ && !stream->notice().empty()) {
    noticeLogged_ = true;
    panel_->log(QString::fromStdString(stream->notice()));
  }
  if (!stream) return;
  const std::vector<std::string> remarks = stream->remarks();
  for (; remarksLogged_ < remarks.size(); ++remarksLogged_)
    panel_->log(QString::fromStdString(escapedLine(remarks[remarksLogged_])));
}

std::vector<DockSpec> LinkFeature::docks() {
  return {{.dock = dock_, .key = QKeySequence("Ctrl+J"), .tab = 1, .shownIn = {Preset::kRecord}}};
}

std::vector<BannerSpec> LinkFeature::strips() { return {{BannerSpec::Order::kAlarm, alarms_}}; }

}  // namespace palpate::gui

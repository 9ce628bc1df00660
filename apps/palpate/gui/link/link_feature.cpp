#include "gui/link/link_feature.h"

#include <QApplication>

#include "gui/link/link_panel.h"
#include "gui/widgets/dock.h"
#include "gui/widgets/message_banner.h"

namespace palpate::gui {
namespace {

constexpr const char* kMutedKey = "alarms/muted";

}  // namespace

LinkFeature::LinkFeature(Bench& bench, QWidget* window)
    : Feature(bench, window),
      actions_(bench.actions),
      panel_(new LinkPanel(window)),
      alarms_(new MessageBanner(window, "AlarmStrip", "alarm")) {
  dock_ = new Dock("Link", panel_, nullptr, window);
  connectLog();
  connectAlarms();
  connectOthers();
  connect(&bench.live, &LiveController::looked, this, &LinkFeature::look);
  connect(&bench.live,
          &LiveController::eventsCame,
          this,
          [this](const std::vector<RecordingEvent>& events) {
            for (const RecordingEvent& event : events) panel_->addEvent(event);
          });
  followTheme(panel_);
  followTheme(alarms_);
}

// Behind the log: who listens is told that a hand is connected before what streams of it.
void LinkFeature::connectOthers() {
  Bench& bench = this->bench();
  others_ = std::make_unique<OtherPrograms>(
      OtherProgramsOptions{actions_,
                           bench.live,
                           bench.settings,
                           [&bench] { return loadRecordingSettings(bench.settings); }},
      nullptr);
  connect(others_.get(), &OtherPrograms::changed, panel_, [this] {
    panel_->showOtherPrograms(others_->facts());
  });
  connect(others_.get(), &OtherPrograms::logged, panel_, &LinkPanel::log);
  connect(others_.get(), &OtherPrograms::failed, panel_, [this](const QString& why) {
    this->bench().messages.fail(why);
    panel_->log(why);
  });
  panel_->showOtherPrograms(others_->facts());
}

void LinkFeature::connectLog() {
  LiveController& live = bench().live;
  connect(&bench().messages, &Messages::linkLogged, panel_, &LinkPanel::log);
  connect(panel_, &LinkPanel::logged, this, [this](const QString& line) {
    // What the banner has just said isn't said again.
    ActivityLog& log = bench().log;
    const int last = log.rowCount() - 1;
    if (last >= 0 && line.contains(log.line(last).text)) return;
    log.add(line.startsWith("alarm") ? LogLine::Severity::kWarning : LogLine::Severity::kInfo,
            line);
  });
  connect(&live, &LiveController::came, this, [this, &live] {
    panel_->log("connected: " + describe(live.source()->connection));
  });
  connect(&live, &LiveController::failed, this, [this](const QString& message) {
    bench().messages.fail(message);
    panel_->log("not connected: " + message);
  });
  connect(&live, &LiveController::leaving, this, [this, &live] {
    panel_->clear();
    bell_.hear({}, 0);
    panel_->log("disconnected: " + describe(live.connection()));
  });
}

void LinkFeature::connectAlarms() {
  connect(&bell_, &AlarmBell::changed, this, [this](const QStringList& alarms) {
    panel_->showAlarms(alarms);
    // Closed by the user it stays closed until something new is wrong.
    if (alarms.isEmpty() || alarmIsNew_ || !alarms_->isHidden()) alarms_->showAll(alarms);
    alarmIsNew_ = false;
  });
  connect(&bell_, &AlarmBell::raised, this, [this](const QString& text) {
    alarmIsNew_ = true;
    panel_->log("alarm: " + text);
    QApplication::alert(window());
  });
  connect(panel_, &LinkPanel::mutedChanged, this, &LinkFeature::mute);
  on(actions_.muteAlarms, [this](bool muted) { mute(muted); });
  mute(bench().settings.value(kMutedKey, false).toBool());
  bench().escape.add(Escape::Order::kAlarm, [this] {
    if (alarms_->isHidden()) return false;
    alarms_->hide();
    return true;
  });
}

void LinkFeature::mute(bool muted) {
  bell_.setMuted(muted);
  panel_->setMuted(muted);
  actions_.muteAlarms->setChecked(muted);
  bench().settings.setValue(kMutedKey, muted);
}

// Four times a second.
void LinkFeature::look() {
  LiveController& live = bench().live;
  LiveSource* source = live.source();
  if (!source) return;
  const LinkHealth& health = live.health();
  bell_.hear(source->finished() ? std::vector<Alarm>() : health.alarms,
             systemClock().monotonicUs());
  panel_->showHealth(health, live.beforeRun());
}

std::vector<DockOffer> LinkFeature::docks() {
  return {{.dock = dock_, .key = QKeySequence("Ctrl+J"), .tab = 1, .shownLive = true}};
}

std::vector<StripOffer> LinkFeature::strips() { return {{StripOffer::Order::kAlarm, alarms_}}; }

}  // namespace palpate::gui

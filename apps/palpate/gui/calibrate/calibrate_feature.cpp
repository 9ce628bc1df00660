#include "gui/calibrate/calibrate_feature.h"

#include <QFileInfo>
#include <utility>

#include <palpate/core/number_text.h>

#include "gui/calibrate/calibrate_panel.h"
#include "gui/calibrate/force_page.h"
#include "gui/calibrate/noise_page.h"
#include "gui/calibrate/pressure_page.h"
#include "gui/calibrate/step_page.h"
#include "gui/calibrate/tare_page.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

constexpr const char* kTareKind = "tare";  // of events
constexpr const char* kSettingsKind = "sensor_settings";
constexpr int kCalibrateUsualWidth = 640;  // [px] its tables are read without scrolling

}  // namespace

CalibrateFeature::CalibrateFeature(Bench& bench, QWidget* window)
    : Feature(bench, window), panel_(new CalibratePanel(bench.settings, window)) {
  dock_ = new Dock("Calibrate", panel_, &panel_->header(), window);
  pressures_ = std::make_unique<Pressures>(bench, panel_->force());
  connect(&bench.subject, &Subject::shown, this, &CalibrateFeature::takeSource);
  connect(&bench.events, &EventDesk::changed, this, &CalibrateFeature::takeKept);
  followTheme(panel_);
  connect(
      &bench.playback, &PlaybackController::positionChanged, panel_, &CalibratePanel::setPosition);
  connect(panel_, &CalibratePanel::said, &bench.messages, &Messages::flash);
  connectPages();
  connectNoise();
  bench.events.addFound([this](const OpenedRecordingPtr& recording, std::vector<EventMark>& marks) {
    const auto& found = panel_->steps().found();
    if (found && panel_->steps().source() == recording) addSteps(found->report, *recording, marks);
  });
  bench.escape.add(Escape::Order::kComputation, [this] { return panel_->cancel(); });
}

void CalibrateFeature::connectPages() {
  Bench& bench = this->bench();
  PlaybackController& playback = bench.playback;
  connect(&panel_->steps(), &StepPage::spanChosen, this, &CalibrateFeature::zoomTo);
  connect(&panel_->tare(), &TarePage::spanChosen, this, &CalibrateFeature::zoomTo);
  connect(&panel_->steps(), &StepPage::sought, &playback, &PlaybackController::seekSeconds);
  connect(&panel_->force(), &ForcePage::sought, &playback, &PlaybackController::seekSeconds);
  connect(&panel_->steps(), &StepPage::foundChanged, &bench.events, &EventDesk::renewMarks);
  connect(&panel_->tare(), &TarePage::keepAsked, this, [this, &bench] {
    const OpenedRecordingPtr recording = bench.subject.recorded();
    if (!recording) return;
    bench.events.keep(
        kTareKind, tareEvent(*panel_->tare().found(), recording->profile), "the zero");
    bench.messages.flash("the zero is kept with the recording: save with Ctrl+S");
  });
  connect(&panel_->tare(), &TarePage::removeAsked, this, [&bench] {
    bench.events.keep(kTareKind, std::nullopt, "the zero");
    bench.messages.flash("no zero is kept with the recording: save with Ctrl+S");
  });
  connect(
      &panel_->force(), &ForcePage::keepAsked, this, [&bench](double sensitivity, double counts) {
        const OpenedRecordingPtr recording = bench.subject.recorded();
        if (!recording) return;
        RecordingEvent event;
        event.tUs = event.t1Us = recording->profile.frameTimeUs(0);
        event.kind = kSettingsKind;
        event.text = "sensitivity " + numberText(sensitivity) + ", threshold " + numberText(counts);
        event.json = jsonOf(SensorSettings{sensitivity, counts, true}).text(-1);
        bench.events.keep(kSettingsKind, event, "the sensor's settings");
        bench.messages.flash("the sensor's settings are kept with the recording: save with Ctrl+S");
      });
  connect(&panel_->force(), &ForcePage::applied, pressures_.get(), &Pressures::reload);
  connect(&panel_->pressure(), &PressurePage::applyAsked, this, &CalibrateFeature::apply);
}

void CalibrateFeature::connectNoise() {
  Bench& bench = this->bench();
  connect(&panel_->noise(), &NoisePage::applyAsked, this, [&bench](const NoiseFloor& floor) {
    const HandDescription* hand = bench.subject.hand();
    applyNoise(bench.settings, hand ? hand->name : sdh2().name, floor);
    bench.messages.flash("noise lines applied: the dock Hand has \"High sensitivity\"");
  });
  bench.handRequests.noiseLines = [&bench](const std::string& hand) {
    return appliedNoise(bench.settings, hand);
  };
  connect(&bench.handRequests,
          &HandRequests::highSensitivityChanged,
          this,
          &CalibrateFeature::filterGhosts);
}

void CalibrateFeature::takeSource() {
  const Subject& subject = bench().subject;
  panel_->setSource(subject.behind(), subject.isLive());
  panel_->setPosition(bench().playback.positionS());
  takeKept();
  pressures_->renew();
}

void CalibrateFeature::takeKept() {
  const EventEditor* editor = bench().events.editor();
  const KeptWithRecording kept =
      editor ? keptWith(*bench().subject.recorded(), editor->events()) : KeptWithRecording{};
  panel_->tare().setKept(kept.tare || !kept.trouble.isEmpty());
  panel_->force().setKept(kept);
  pressures_->setKept(kept);
}

// To the hand of what is looked at, else to the one that the calibration was made of.
void CalibrateFeature::apply(const QString& path) {
  const OpenedRecordingPtr& recording = bench().subject.behind();
  const auto& made = panel_->pressure().shownCalibration();
  applyCalibration(
      bench().settings, recording ? recording->profile.hand().name : made->calibration.hand, path);
  panel_->force().calibrationChanged();
  pressures_->reload();
  bench().messages.flash("applied: " + QFileInfo(path).fileName());
}

// Thresholds at the noise let ghosts through: a filter takes them away, as long as they are there.
void CalibrateFeature::filterGhosts(bool on) {
  Filtering& filtering = bench().filtering;
  if (on) {
    filtersBefore_ = Filters{filtering.recipe(), filtering.on()};
    filtering.editor().setRecipe(highSensitivityRecipe());
    filtering.setOn(true);
    return;
  }
  const auto before = std::exchange(filtersBefore_, std::nullopt);
  // Others were chosen meanwhile: these stay.
  if (!before || !filtering.recipe().sameSteps(highSensitivityRecipe())) return;
  filtering.editor().setRecipe(before->recipe);
  filtering.setOn(before->on);
}

void CalibrateFeature::zoomTo(double fromS, double toS) {
  bench().selection.setSpan(TimeSpan{fromS, toS});
  bench().selection.showWithAir({fromS, toS});
  bench().playback.seekSeconds(fromS);
}

void CalibrateFeature::settle() { panel_->settle(); }

std::vector<DockOffer> CalibrateFeature::docks() {
  return {{.dock = dock_,
           .key = QKeySequence("Ctrl+Shift+N"),  // newtons
           .tab = 6,
           .roomPx = kCalibrateUsualWidth}};
}

std::vector<ExportedView> CalibrateFeature::views() {
  ExportedView view;
  view.name = "Calibrate";
  view.widget = panel_;
  view.isThere = [this] { return panel_->page().shown(); };
  view.fileName = [this] { return bench().recordingStem() + "_" + panel_->pageName().toLower(); };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    panel_->page().paint(painter, look, bench().pictureTitle());
  };
  view.tables = [this] { return panel_->page().tables(); };
  return {view};
}

}  // namespace palpate::gui

#include "gui/calibrate/calibrate_feature.h"

#include <QFileInfo>

#include <palpate/control/grasp_request.h>
#include <palpate/core/error.h>
#include <palpate/core/number_text.h>

#include "gui/calibrate/calibrate_panel.h"
#include "gui/calibrate/force_page.h"
#include "gui/calibrate/noise_page.h"
#include "gui/calibrate/pressure_page.h"
#include "gui/calibrate/step_page.h"
#include "gui/calibrate/tare_page.h"
#include "gui/widgets/content_scroll.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

constexpr const char* kTareKind = "tare";  // event kinds
constexpr const char* kTareAdded = "tare added to the recording: save with Ctrl+S";
constexpr const char* kSettingsKind = "sensor_settings";
// An event that comes before the file is begun may be left out.
bool isBeingRecorded(const RecorderStatus& status) {
  return status.state == RecorderStatus::State::kRecording;
}

// [px]; the tables fit without scrolling
constexpr int kCalibrateUsualWidth = 640;

}  // namespace

CalibrateFeature::CalibrateFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      panel_(new CalibratePanel(windowState.settings, windowState.ask, window)),
      calibrations_(new CalibrationCache(window)) {
  dock_ =
      new Dock("Calibrate", new ContentScroll(panel_, kMinDockContent), &panel_->header(), window);
  pressures_ = std::make_unique<Pressures>(windowState, *calibrations_, panel_->force());
  connect(&windowState.displayed, &DisplayedSource::shown, this, &CalibrateFeature::takeSource);
  connect(&windowState.events, &EventController::changed, this, &CalibrateFeature::takeKept);
  followUnits(&panel_->force());
  connect(&windowState.playback,
          &PlaybackController::positionChanged,
          panel_,
          &CalibratePanel::setPosition);
  connect(panel_, &CalibratePanel::said, &windowState.messages, &Messages::flash);
  connectPages();
  connectNoise();
  connectLive();
  windowState.events.addFound(
      [this](const OpenedRecordingPtr& recording, std::vector<EventMark>& marks) {
        const auto& found = panel_->steps().found();
        // Closed with the dock, which alone can remove them.
        if (found && panel_->steps().source() == recording && !stepsHidden_)
          addSteps(found->report, *recording, marks);
      });
  connect(dock_->toggleViewAction(), &QAction::toggled, this, [this](bool open) {
    stepsHidden_ = !open;
    state().events.renewMarks();
  });
  windowState.escapeHandler.add(EscapeHandler::Order::kComputation,
                                [this] { return panel_->cancel(); });
}

void CalibrateFeature::connectPages() {
  WindowState& windowState = state();
  PlaybackController& playback = windowState.playback;
  connect(&panel_->steps(), &StepPage::spanChosen, this, &CalibrateFeature::zoomTo);
  connect(&panel_->tare(), &TarePage::spanChosen, this, &CalibrateFeature::zoomTo);
  connect(&panel_->steps(), &StepPage::seekRequested, &playback, &PlaybackController::seekSeconds);
  connect(&panel_->force(), &ForcePage::seekRequested, &playback, &PlaybackController::seekSeconds);
  connect(
      &panel_->steps(), &StepPage::foundChanged, &windowState.events, &EventController::renewMarks);
  connect(&panel_->tare(), &TarePage::keepRequested, this, &CalibrateFeature::keepTare);
  connect(&panel_->tare(), &TarePage::removeRequested, this, [&windowState] {
    windowState.events.keep(kTareKind, std::nullopt, "the tare");
    windowState.messages.flash("tare removed from the recording: save with Ctrl+S");
  });
  connect(&panel_->force(),
          &ForcePage::keepRequested,
          this,
          [&windowState](double sensitivity, double counts) {
            const OpenedRecordingPtr recording = windowState.displayed.recorded();
            if (!recording) return;
            Event event;
            event.tUs = event.t1Us = recording->profile.frameTimeUs(0);
            event.kind = kSettingsKind;
            event.text =
                "sensitivity " + numberText(sensitivity) + ", threshold " + numberText(counts);
            event.json = jsonOf(SensorSettings{sensitivity, counts, true}).text(-1);
            windowState.events.keep(kSettingsKind, event, "the sensor's settings");
            windowState.messages.flash("sensor settings added to the recording: save with Ctrl+S");
          });
  connect(&panel_->force(), &ForcePage::applied, pressures_.get(), &Pressures::reload);
  connect(&panel_->force(),
          &ForcePage::applied,
          &windowState.handCommands,
          &HandCommands::calibrationApplied);
  windowState.handCommands.calibration =
      [this, &windowState](const std::string& hand) -> std::optional<Calibration> {
    const QString path = appliedCalibration(windowState.settings, hand);
    const CalibrationCache::Known* known = path.isEmpty() ? nullptr : calibrations_->find(path);
    // The page Force tells why there is none.
    return known ? known->calibration : std::nullopt;
  };
  windowState.handCommands.calibrationBeingRead = [this, &windowState](const std::string& hand) {
    const QString path = appliedCalibration(windowState.settings, hand);
    return !path.isEmpty() && !calibrations_->find(path);
  };
  connect(calibrations_,
          &CalibrationCache::changed,
          &windowState.handCommands,
          &HandCommands::calibrationApplied);
  connect(&panel_->pressure(), &PressurePage::applyRequested, this, &CalibrateFeature::apply);
}

void CalibrateFeature::connectNoise() {
  WindowState& windowState = state();
  connect(
      &panel_->noise(), &NoisePage::applyRequested, this, [&windowState](const NoiseFloor& floor) {
        const HandDescription* hand = windowState.displayed.hand();
        applyNoise(windowState.settings, hand ? hand->name : movableHand().name, floor);
        emit windowState.handCommands.noiseLinesApplied();
        windowState.messages.flash(
            "noise lines applied: \"High sensitivity\" in the dock Hand uses them");
      });
  windowState.handCommands.noiseLines = [&windowState](const std::string& hand) {
    return appliedNoise(windowState.settings, hand);
  };
  connect(&windowState.handCommands,
          &HandCommands::highSensitivityChanged,
          this,
          &CalibrateFeature::filterGhosts);
}

// Measurements of the connected hand.
void CalibrateFeature::connectLive() {
  LiveController& live = state().live;
  connect(&live, &LiveController::sourceOpened, this, [this, &live] {
    const QString path =
        appliedCalibration(state().settings, live.source()->session->device().hand().name);
    if (!path.isEmpty()) calibrations_->renew(path);
    panel_->setSession(live.source()->session.get());
  });
  connect(&live, &LiveController::leaving, this, [this] {
    panel_->setSession(nullptr);
    panel_->tare().setRecordingRuns(false);
  });
  connect(&live, &LiveController::refreshed, this, [this, &live] {
    panel_->tare().setRecordingRuns(isBeingRecorded(live.health().recorder));
  });
}

void CalibrateFeature::keepTare() {
  WindowState& windowState = state();
  TarePage& page = panel_->tare();
  if (windowState.displayed.isLive()) {
    LiveSource* source = windowState.live.source();
    const OpenedRecordingPtr measured = page.foundIn();
    if (!source || !measured || !isBeingRecorded(source->session->recorderStatus())) return;
    CaptureSession& session = *source->session;
    session.note(liveTareEvent(*page.found(), measured->profile, session.nowUs()));
    page.setAdded();
    windowState.messages.flash("tare added to the recording that is running");
    return;
  }
  const OpenedRecordingPtr recording = windowState.displayed.recorded();
  if (!recording) return;
  windowState.events.keep(kTareKind, tareEvent(*page.found(), recording->profile), "the tare");
  windowState.messages.flash(kTareAdded);
}

void CalibrateFeature::takeSource() {
  const DisplayedSource& displayed = state().displayed;
  panel_->setSource(displayed.unfilteredRecording(), displayed.isLive());
  if (const HandDescription* hand = displayed.hand()) panel_->pressure().setHand(*hand);
  panel_->setPosition(state().playback.positionS());
  takeKept();
  pressures_->renew();
}

void CalibrateFeature::takeKept() {
  const EventEditor* editor = state().events.editor();
  const KeptWithRecording kept =
      editor ? keptWith(*state().displayed.recorded(), editor->events()) : KeptWithRecording{};
  // Undo has removed it.
  if (!kept.tare) state().messages.takeBack(kTareAdded);
  panel_->tare().setKept(kept.tare || !kept.problem.isEmpty());
  panel_->force().setKept(kept);
  pressures_->setKept(kept);
}

// Applies the calibration to the hand of the shown recording, else to the hand that the calibration
// was made for.
void CalibrateFeature::apply(const QString& path) {
  const OpenedRecordingPtr& recording = state().displayed.unfilteredRecording();
  const auto& made = panel_->pressure().shownCalibration();
  applyCalibration(
      state().settings, recording ? recording->profile.hand().name : made->calibration.hand, path);
  panel_->force().calibrationChanged();
  // The connected hand may be another one than the shown.
  calibrations_->renew(path);
  pressures_->reload();
  emit state().handCommands.calibrationApplied();
  state().messages.flash("applied: " + QFileInfo(path).fileName());
}

// While thresholds are at the noise level, ghosts pass them; a filter removes them for that time.
void CalibrateFeature::filterGhosts(bool on) {
  ActiveFilters& activeFilters = state().activeFilters;
  if (on)
    activeFilters.lend(highSensitivityRecipe());
  else
    activeFilters.giveBack();
}

void CalibrateFeature::zoomTo(double fromS, double toS) {
  state().selection.setSpan(TimeSpan{fromS, toS});
  state().selection.showWithMargin({fromS, toS});
  state().playback.seekSeconds(fromS);
}

void CalibrateFeature::settle() { panel_->settle(); }

std::vector<DockSpec> CalibrateFeature::docks() {
  return {{.dock = dock_,
           .key = QKeySequence("Ctrl+Shift+N"),  // N for newtons
           .menu = "Analysis",
           .tab = 6,
           .preferredWidthPx = kCalibrateUsualWidth}};
}

std::vector<ExportedView> CalibrateFeature::views() {
  ExportedView view;
  view.name = "Calibrate";
  view.minHeightShare = kChartHeight;
  view.widget = panel_;
  view.isThere = [this] { return panel_->page().shown(); };
  view.fileName = [this] { return state().recordingStem() + "_" + panel_->pageName().toLower(); };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    panel_->page().paint(painter, look, state().pictureTitle());
  };
  view.tables = [this] { return panel_->page().tables(); };
  return {view};
}

}  // namespace palpate::gui

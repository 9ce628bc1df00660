#include "gui/shell/main_window_calibrate.h"

#include <QFileInfo>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>

#include "gui/calibrate/calibrate_panel.h"
#include "gui/calibrate/force_page.h"
#include "gui/calibrate/noise_page.h"
#include "gui/calibrate/pressure_page.h"
#include "gui/calibrate/step_page.h"
#include "gui/calibrate/tare_page.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

constexpr const char* kTareKind = "tare";  // of events
constexpr const char* kSettingsKind = "sensor_settings";
constexpr int kMainWindowCalibrateUsualWidth = 640;  // [px] its tables are read without scrolling

}  // namespace

MainWindow::CalibrateView::CalibrateView(MainWindow& window) : QObject(&window), window_(window) {
  panel_ = new CalibratePanel(window.settings_, &window);
  dock_ = new Dock("Calibrate", panel_, &panel_->header(), &window);
  dock_->toggleViewAction()->setShortcut(QKeySequence("Ctrl+Shift+N"));  // newtons
  window.docks_.append(dock_);
}

void MainWindow::CalibrateView::place() {
  window_.addDockWidget(Qt::RightDockWidgetArea, dock_);
  window_.tabifyDockWidget(window_.inspectDock_, dock_);
  dock_->hide();
}

void MainWindow::CalibrateView::connectAll() {
  MainWindow& window = window_;
  connect(panel_, &CalibratePanel::said, &window, &MainWindow::flash);
  connect(&window.playback_,
          &PlaybackController::positionChanged,
          panel_,
          &CalibratePanel::setPosition);
  connect(&panel_->steps(), &StepPage::spanChosen, this, &CalibrateView::zoomTo);
  connect(&panel_->tare(), &TarePage::spanChosen, this, &CalibrateView::zoomTo);
  connect(&panel_->steps(), &StepPage::sought, &window.playback_, &PlaybackController::seekSeconds);
  connect(
      &panel_->force(), &ForcePage::sought, &window.playback_, &PlaybackController::seekSeconds);
  connect(&panel_->tare(), &TarePage::keepAsked, this, [this] {
    keep(kTareKind, tareEvent(*panel_->tare().found(), window_.current_->profile), "the zero");
    window_.flash("the zero is kept with the recording: save with Ctrl+S");
  });
  connect(&panel_->tare(), &TarePage::removeAsked, this, [this] {
    keep(kTareKind, std::nullopt, "the zero");
    window_.flash("no zero is kept with the recording: save with Ctrl+S");
  });
  connect(&panel_->force(), &ForcePage::keepAsked, this, [this](double sensitivity, double counts) {
    const SensorSettings said{sensitivity, counts, true};
    RecordingEvent event;
    event.tUs = event.t1Us = window_.current_->profile.frameTimeUs(0);
    event.kind = kSettingsKind;
    event.text = "sensitivity " + numberText(sensitivity) + ", threshold " + numberText(counts);
    event.json = jsonOf(said).text(-1);
    keep(kSettingsKind, event, "the sensor's settings");
    window_.flash("the sensor's settings are kept with the recording: save with Ctrl+S");
  });
  connect(&panel_->pressure(), &PressurePage::applyAsked, this, [this](const QString& path) {
    const auto& made = panel_->pressure().shownCalibration();
    const auto& current = window_.current_;
    applyCalibration(
        window_.settings_, current ? current->profile.hand().name : made->calibration.hand, path);
    panel_->force().calibrationChanged();
    applied();
    window_.flash("applied: " + QFileInfo(path).fileName());
  });
  connectPressures();
  connect(dock_->toggleViewAction(), &QAction::triggered, this, [this](bool shown) {
    if (!shown) return;
    dock_->raise();
    makeRoomFor(dock_);
  });
}

// Asked for, its tables are to be read.
void MainWindow::CalibrateView::makeRoomFor(const Dock* asked) {
  if (asked != dock_) return;
  QTimer::singleShot(0, this, [this] {
    if (dock_->isFloating() || dock_->width() >= kMainWindowCalibrateUsualWidth) return;
    window_.resizeDocks({dock_}, {kMainWindowCalibrateUsualWidth}, Qt::Horizontal);
  });
}

void MainWindow::CalibrateView::show() {
  panel_->setSource(window_.current_, window_.liveShown_);
  followEvents();
  panel_->setTheme(resolved(window_.view_.theme));
  panel_->setPosition(window_.playback_.positionS());
  renewPressures();
}

void MainWindow::CalibrateView::zoomTo(double fromS, double toS) {
  window_.timeline_->setSelection(TimeSpan{fromS, toS});
  window_.timeline_->showSpan({fromS, toS});
  window_.playback_.seekSeconds(fromS);
}

void MainWindow::CalibrateView::followEvents() {
  EventEditor* editor = window_.events();
  if (editor == followed_) return;
  if (followed_) disconnect(followed_, nullptr, this, nullptr);
  followed_ = editor;
  if (editor != nullptr) connect(editor, &EventEditor::changed, this, &CalibrateView::tellKept);
  tellKept();
}

void MainWindow::CalibrateView::tellKept() {
  kept_ = followed_ ? keptWith(*window_.current_, followed_->events()) : KeptWithRecording{};
  panel_->tare().setKept(kept_.tare || !kept_.trouble.isEmpty());
  panel_->force().setKept(kept_);
  renewPressures();
}

void MainWindow::CalibrateView::keep(const std::string& kind,
                                     const std::optional<RecordingEvent>& event,
                                     const QString& name) {
  EventEditor* editor = window_.events();
  if (editor == nullptr) return;
  editor->changeTogether(name, [&] {
    for (std::size_t i = editor->events().size(); i-- > 0;)
      if (editor->events()[i].kind == kind) editor->remove(i, name);
    if (event) editor->add(*event, name);
  });
}

bool MainWindow::CalibrateView::cancel() { return panel_->cancel(); }

void MainWindow::CalibrateView::leave() { delete dock_; }

void MainWindow::CalibrateView::addSteps(std::vector<EventMark>& marks) const {
  const auto& found = panel_->steps().found();
  if (found && panel_->steps().source() == window_.current_)
    palpate::gui::addSteps(found->report, *window_.current_, marks);
}

ExportedView MainWindow::CalibrateView::exported() {
  ExportedView view;
  view.name = "Calibrate";
  view.widget = panel_;
  view.isThere = [this] { return panel_->page().shown(); };
  view.fileName = [this] { return window_.recordingStem() + "_" + panel_->pageName().toLower(); };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    panel_->page().paint(painter, look, window_.exportOptions().title);
  };
  view.tables = [this] { return panel_->page().tables(); };
  return view;
}

}  // namespace palpate::gui

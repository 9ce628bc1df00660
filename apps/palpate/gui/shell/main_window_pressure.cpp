// The main window's pressures and forces: what a calibration makes of the counts, beside them, of a recording or live;
// and what the hand's high sensitivity goes by.
#include <QFileInfo>

#include <palpate/core/error.h>

#include "gui/calibrate/calibrate_panel.h"
#include "gui/calibrate/force_page.h"
#include "gui/calibrate/noise_page.h"
#include "gui/calibrate/step_page.h"
#include "gui/filter/filter_panel.h"
#include "gui/hand/hand_dock.h"
#include "gui/hand/sensitivity_modes.h"
#include "gui/inspect/inspect_panel.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/matrices/matrices_view.h"
#include "gui/shell/main_window_calibrate.h"
#include "gui/space/hand_panel.h"

namespace palpate::gui {
namespace {

constexpr const char* kNone = "none: values are counts";

}  // namespace

void MainWindow::CalibrateView::connectPressures() {
  connect(&panel_->force(), &ForcePage::applied, this, &CalibrateView::applied);
  connect(&panel_->steps(), &StepPage::foundChanged, &window_, &MainWindow::showEvents);
  connect(&window_.playback_, &PlaybackController::positionChanged, this, [this] { showFrame(); });
  connect(&window_.live_, &LiveController::came, this, [this] { renewPressures(); });
  connect(&panel_->noise(), &NoisePage::applyAsked, this, [this](const NoiseFloor& floor) {
    const LiveSource* source = window_.live_.source();
    const std::string hand = window_.liveShown_ && source ? source->session->device().hand().name
                             : window_.current_           ? window_.current_->profile.hand().name
                                                          : sdh2().name;
    applyNoise(window_.settings_, hand, floor);
    window_.flash("noise lines applied: the dock Hand has \"High sensitivity\"");
  });
  SensitivityModes& modes = window_.hand_->sensitivity();
  modes.noiseLines = [this](const std::string& hand) {
    return appliedNoise(window_.settings_, hand);
  };
  connect(&modes, &SensitivityModes::highChanged, this, &CalibrateView::filterGhosts);
}

// Thresholds at the noise let ghosts through: a filter takes them away, as long as they are there.
void MainWindow::CalibrateView::filterGhosts(bool on) {
  FilterPanel& filter = *window_.filter_;
  if (on) {
    filtersBefore_ = Filters{filter.editor().recipe(), filter.on()};
    filter.editor().setRecipe(highSensitivityRecipe());
    filter.setOn(true);
    return;
  }
  const auto before = std::exchange(filtersBefore_, std::nullopt);
  // Others were chosen meanwhile: these stay.
  if (!before || !filter.editor().recipe().sameSteps(highSensitivityRecipe())) return;
  filter.editor().setRecipe(before->recipe);
  filter.setOn(before->on);
}

void MainWindow::CalibrateView::applied() {
  told_.reset();
  renewPressures();
  window_.updateStatus();
}

void MainWindow::CalibrateView::renewPressures() {
  LiveSource* source = window_.live_.source();
  const bool live = window_.liveShown_ && source;
  const std::string hand = live               ? source->session->device().hand().name
                           : window_.current_ ? window_.current_->profile.hand().name
                                              : std::string();
  const QString path = hand.empty() ? QString() : appliedCalibration(window_.settings_, hand);
  Told now{live               ? static_cast<const void*>(source->history.get())
           : window_.current_ ? static_cast<const void*>(window_.current_.get())
                              : nullptr,
           path,
           live ? KeptWithRecording{} : kept_};
  if (told_ && *told_ == now) return;
  told_ = std::move(now);
  reader_.reset();
  text_ = path.isEmpty() ? QString(kNone) : QFileInfo(path).fileName();
  try {
    if (live)
      renewLive(path);
    else if (window_.current_ && !path.isEmpty())
      renewRecording(path);
  } catch (const Error& error) {
    text_ = QString("can't be used: ") + error.what();
  } catch (const std::invalid_argument& error) {
    text_ = QString("can't be used: ") + error.what();
  }
  window_.inspect_->setCalibration(text_);
  showForces(nullptr);
  if (!live) showFrame();
}

void MainWindow::CalibrateView::renewLive(const QString& path) {
  LiveSource& source = *window_.live_.source();
  source.pressure->setCalibration(std::nullopt);
  panel_->force().setLiveHand(source.session->device().hand());
  if (!path.isEmpty()) source.pressure->setCalibration(usableCalibration(path));
}

void MainWindow::CalibrateView::renewRecording(const QString& path) {
  if (!kept_.trouble.isEmpty()) throw Error(kept_.trouble.toStdString());
  reader_ = std::make_unique<PressureReader>(window_.current_->profile,
                                             usableCalibration(path),
                                             pressureOptions(kept_, std::nullopt),
                                             kept_.tare);
}

// The frame of the recording at which the cursor stands.
void MainWindow::CalibrateView::showFrame() {
  if (!reader_ || window_.liveShown_ || !window_.playback_.hasFrames()) return;
  try {
    showForces(std::make_shared<const PressureFrame>(reader_->at(window_.playback_.frame())));
  } catch (const Error&) {
    showForces(nullptr);  // said where the frame would be
  }
}

void MainWindow::CalibrateView::showLive(const LiveResults& results) {
  showForces(results.pressure);
  const LiveSource* source = window_.live_.source();
  if (!source) return;
  if (results.pressure && panel_->force().isVisible())
    panel_->force().showLive(*results.pressure, source->pressure->assumptions());
}

void MainWindow::CalibrateView::showForces(const std::shared_ptr<const PressureFrame>& pressure) {
  window_.matrices_->view().setPressure(pressure);
  window_.handPanel_->view().setPressure(pressure);
  std::vector<MatrixTableModel::Force> rows;
  if (pressure) {
    for (const MatrixPressure& matrix : pressure->matrices)
      rows.push_back({matrix.forceN, matrix.sdForceN, matrix.inRange});
    rows.push_back({pressure->forceN, pressure->sdForceN, pressure->inRange});
  }
  window_.inspect_->table().showForces(rows, "no calibration: Calibrate, Ctrl+Shift+N");
}

}  // namespace palpate::gui

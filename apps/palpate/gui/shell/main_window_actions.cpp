// What the main window's actions and controls do.
#include <QComboBox>
#include <algorithm>

#include "gui/help/about_dialog.h"
#include "gui/help/keys_dialog.h"
#include "gui/inspect/inspect_panel.h"
#include "gui/look/next_choice.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/playback/playback_bar.h"
#include "gui/shell/main_window_recognise.h"
#include "gui/timeline/live_chart.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/timeline/timeline_header.h"

namespace palpate::gui {
namespace {

constexpr int kFlashMs = 5000;
constexpr int kTenFrames = 10;
constexpr double kMainWindowActionsZoomStep = 1.5;

}  // namespace

void MainWindow::connectPlayback() {
  connect(&playback_, &PlaybackController::frameChanged, this, &MainWindow::showFrame);
  connect(&playback_, &PlaybackController::positionChanged, this, [this](double position) {
    timeline_->setPosition(position);
    updateStatus();
  });
  connect(&playback_, &PlaybackController::stateChanged, this, &MainWindow::showPlaybackState);
  connect(timeline_, &TimelineChart::sought, &playback_, &PlaybackController::seekSeconds);
  const auto on = [this](QAction* action, auto what) {
    connect(action, &QAction::triggered, this, what);
  };
  on(actions_.play, [this] { playback_.togglePlay(); });
  on(actions_.stepBack, [this] { playback_.step(-1); });
  on(actions_.stepForward, [this] { playback_.step(1); });
  on(actions_.tenBack, [this] { playback_.step(-kTenFrames); });
  on(actions_.tenForward, [this] { playback_.step(kTenFrames); });
  on(actions_.toStart, [this] { playback_.seekFrame(0); });
  on(actions_.toEnd, [this] {
    playback_.pause();
    playback_.seekFrame(playback_.numFrames());
  });
  on(actions_.goToFrame, [this] { playbackBar_->editFrame(); });
  on(actions_.faster, [this] { playback_.faster(); });
  on(actions_.slower, [this] { playback_.slower(); });
  on(actions_.loop, [this](bool checked) {
    loopIsOfDemo_ = false;
    playback_.setLoop(checked);
  });
  on(actions_.skipGaps, [this](bool checked) { playback_.setSkipGaps(checked); });
  connect(menus_->speed, &QComboBox::activated, this, [this](int index) {
    playback_.setSpeed(PlaybackController::kSpeeds[index]);
  });
  connect(actions_.speeds, &QActionGroup::triggered, this, [this](const QAction* action) {
    playback_.setSpeed(PlaybackController::kSpeeds[action->data().toInt()]);
  });
}

void MainWindow::connectViewActions() {
  const auto on = [this](QAction* action, auto what) {
    connect(action, &QAction::triggered, this, what);
  };
  on(actions_.interpolated, [this](bool checked) {
    changeView([&](ViewSettings& view) { view.interpolated = checked; });
  });
  on(actions_.values,
     [this](bool checked) { changeView([&](ViewSettings& view) { view.values = checked; }); });
  on(actions_.nextMap,
     [this] { changeView([](ViewSettings& view) { view.map = after(kAllColorMaps, view.map); }); });
  on(actions_.nextRange, [this] {
    changeView([](ViewSettings& view) { view.range = after(kAllRangeModes, view.range); });
  });
  on(actions_.nextSignal, [this] {
    changeView([](ViewSettings& view) { view.signal = after(kAllPlottedSignals, view.signal); });
  });
  const auto zoom = [this](double factor) {
    if (liveShown_)
      liveChart_->setWindowS(liveChart_->windowS() / factor);
    else
      timeline_->zoom(factor);
  };
  on(actions_.zoomIn, [zoom] { zoom(kMainWindowActionsZoomStep); });
  on(actions_.zoomOut, [zoom] { zoom(1.0 / kMainWindowActionsZoomStep); });
  on(actions_.fit,
     [this] { liveShown_ ? liveChart_->setWindowS(LiveChart::kUsualS) : timeline_->fit(); });
  on(actions_.nextTheme, [this] {
    const bool dark = resolved(view_.theme) == Theme::kDark;
    setTheme(dark ? ThemeChoice::kLight : ThemeChoice::kDark);
  });
  on(actions_.fullScreen, [this](bool checked) { toggleFullScreen(checked); });
  on(actions_.resetLayout, [this] { defaultLayout(); });
  on(actions_.keys, [this] {
    auto* dialog = new KeysDialog(actions(), this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
  });
  on(actions_.about, [this] {
    auto* dialog = new AboutDialog(this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
  });
  on(actions_.dismiss, [this] {
    if (!recognise_->cancel()) dismiss();
  });
  const auto last = actions_.plots.size() - 1;
  for (qsizetype i = 0; i <= last; ++i)
    on(actions_.plots[i], [this, i, last](bool checked) {
      MatrixTableModel& table = inspect_->table();
      if (table.numMatrices() == 0) return;
      table.setPlotted(i == last ? table.numMatrices() : static_cast<std::size_t>(i), checked);
    });
}

void MainWindow::connectChoices() {
  connect(actions_.maps, &QActionGroup::triggered, this, [this](const QAction* action) {
    changeView([&](ViewSettings& view) { view.map = kAllColorMaps.at(action->data().toUInt()); });
  });
  connect(actions_.ranges, &QActionGroup::triggered, this, [this](const QAction* action) {
    changeView(
        [&](ViewSettings& view) { view.range = kAllRangeModes.at(action->data().toUInt()); });
  });
  connect(actions_.signalsPlotted, &QActionGroup::triggered, this, [this](const QAction* action) {
    changeView(
        [&](ViewSettings& view) { view.signal = kAllPlottedSignals.at(action->data().toUInt()); });
  });
  connect(actions_.themes, &QActionGroup::triggered, this, [this](const QAction* action) {
    setTheme(kAllThemeChoices.at(action->data().toUInt()));
  });
  connect(matrices_, &MatricesPanel::mapChosen, this, [this](ColorMapName map) {
    changeView([&](ViewSettings& view) { view.map = map; });
  });
  connect(matrices_, &MatricesPanel::rangeChosen, this, [this](RangeMode mode) {
    changeView([&](ViewSettings& view) { view.range = mode; });
  });
  connect(matrices_, &MatricesPanel::manualRangeChosen, this, [this](double low, double high) {
    changeView([&](ViewSettings& view) {
      view.manualMin = low;
      view.manualMax = high;
    });
  });
  connect(&matrices_->view(), &MatricesView::hovered, this, [this](const QString& text) {
    hover_ = text;
    updateStatus();
  });
  connect(timelineHeader_, &TimelineHeader::signalChosen, this, [this](PlottedSignal signal) {
    changeView([&](ViewSettings& view) { view.signal = signal; });
  });
  connect(&inspect_->table(), &MatrixTableModel::plottedChanged, this, &MainWindow::showPlotted);
  flashTimer_.setSingleShot(true);
  flashTimer_.setInterval(kFlashMs);
  connect(&flashTimer_, &QTimer::timeout, this, [this] {
    flash_.clear();
    updateStatus();
  });
}

void MainWindow::toggleFullScreen(bool on) {
  setWindowState(on ? windowState() | Qt::WindowFullScreen : windowState() & ~Qt::WindowFullScreen);
  actions_.fullScreen->setChecked(on);
}

}  // namespace palpate::gui

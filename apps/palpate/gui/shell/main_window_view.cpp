// The main window's look, status and layout.
#include <QApplication>
#include <QCloseEvent>
#include <QComboBox>
#include <QDateTime>
#include <QStatusBar>
#include <algorithm>
#include <iterator>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>
#include <palpate/core/time.h>

#include "gui/compare/compare_panel.h"
#include "gui/export/take_away.h"
#include "gui/hand/hand_dock.h"
#include "gui/inspect/inspect_panel.h"
#include "gui/library/library_panel.h"
#include "gui/library/log_panel.h"
#include "gui/link/link_panel.h"
#include "gui/look/icons.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/open/start_page.h"
#include "gui/playback/playback_bar.h"
#include "gui/shell/main_window_calibrate.h"
#include "gui/shell/main_window_slip.h"
#include "gui/space/hand_panel.h"
#include "gui/spectrum/spectrum_panel.h"
#include "gui/timeline/live_chart.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/timeline/timeline_header.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/widgets/dock.h"
#include "gui/widgets/message_banner.h"
#include "gui/widgets/offer_strip.h"
#include "gui/widgets/status_strip.h"

namespace palpate::gui {
namespace {

constexpr int kMainWindowViewCompactBelow = 1340;  // [px] of width: buttons lose their text
constexpr int kNarrowestInspect = 455;             // [px] its table is read without eliding
constexpr double kInspectShare = 0.345;            // of the window's width
constexpr double kLiveInspectShare = 0.24;
constexpr int kNarrowestLiveInspect = 330;              // [px]
constexpr int kHandWidth = 380;                         // [px]
constexpr double kMainWindowViewTimelineShare = 0.235;  // of the window's height

template <class Choices, class Choice>
void checkChoice(const QActionGroup* group, const Choices& all, Choice now) {
  const auto index = std::find(std::begin(all), std::end(all), now) - std::begin(all);
  if (index < group->actions().size()) group->actions().at(index)->setChecked(true);
}

QString seconds(double value) { return QString::fromStdString(fixedText(value, 2)) + " s"; }

}  // namespace

void MainWindow::changeView(const std::function<void(ViewSettings&)>& change) {
  change(view_);
  applyView();
}

void MainWindow::applyView() {
  matrices_->setSettings(view_, resolved(view_.theme));
  timelineHeader_->setSignal(view_.signal);
  liveChart_->setSignal(view_.signal);
  showCurves();
  actions_.interpolated->setChecked(view_.interpolated);
  actions_.values->setChecked(view_.values);
  checkChoice(actions_.maps, kAllColorMaps, view_.map);
  checkChoice(actions_.ranges, kAllRangeModes, view_.range);
  checkChoice(actions_.signalsPlotted, kAllPlottedSignals, view_.signal);
  checkChoice(actions_.themes, kAllThemeChoices, view_.theme);
  compare_->setSettings(view_, resolved(view_.theme));
}

void MainWindow::setTheme(ThemeChoice choice) {
  view_.theme = choice;
  applyTheme();
  applyView();
}

void MainWindow::applyTheme() {
  const Theme theme = resolved(view_.theme);
  gui::applyTheme(*qApp, theme);
  actions_.setTheme(theme);
  startPage_->setTheme(theme);
  playbackBar_->setTheme(theme);
  timelinePanel_->setTheme(theme);
  liveChart_->setTheme(theme);
  link_->setTheme(theme);
  for (MessageBanner* banner : {alarmStrip_, banner_}) banner->setTheme(theme);
  offer_->setTheme(theme);
  inspect_->setTheme(theme);
  hand_->setTheme(theme);
  status_->setTheme(theme);
  for (Dock* dock : docks_) dock->setTheme(theme);
  library_->setTheme(theme);
  log_->setTheme(theme);
  showPlotted();
  showPlaybackState();
  showRecordingState();
}

void MainWindow::showFrame(std::size_t frame) {
  try {
    matrices_->showFrame(frame);
    if (!handPanel_->isHidden()) handPanel_->showFrame(frame);
    inspect_->showFrame(frame);
    setPictureOld({});
  } catch (const Error& error) {
    // A damaged block: what is seen is of another frame, or a part of it is.
    setPictureOld({error.what()});
  }
}

void MainWindow::showPlaybackState() {
  const Theme theme = resolved(view_.theme);
  const bool playing = playback_.playing();
  actions_.play->setIconText(playing ? " Pause" : " Play");
  actions_.play->setIcon(makeIcon(playing ? IconShape::kPause : IconShape::kPlay, theme));
  actions_.play->setToolTip(playing ? "Pause (Space)" : "Play by the real time stamps (Space)");
  actions_.loop->setChecked(playback_.loop());
  actions_.skipGaps->setChecked(playback_.skipGaps());
  checkChoice(actions_.speeds, PlaybackController::kSpeeds, playback_.speed());
  const auto* at = std::find(std::begin(PlaybackController::kSpeeds),
                             std::end(PlaybackController::kSpeeds),
                             playback_.speed());
  menus_->speed->setCurrentIndex(
      at == std::end(PlaybackController::kSpeeds)
          ? -1
          : static_cast<int>(at - std::begin(PlaybackController::kSpeeds)));
  updateStatus();
}

void MainWindow::showPlotted() {
  const MatrixTableModel& table = inspect_->table();
  const auto& plotted = table.plotted();
  if (liveShown_) liveChart_->setPlotted(plotted);
  showCurves();
  const auto last = actions_.plots.size() - 1;
  for (qsizetype i = 0; i < last; ++i) {
    const auto row = static_cast<std::size_t>(i);
    const bool there = row < table.numMatrices();
    actions_.plots[i]->setVisible(there);
    actions_.plots[i]->setEnabled(there);
    if (!there) continue;
    actions_.plots[i]->setText("Plot " + QString::fromStdString(table.hand().matrixName(row)));
    actions_.plots[i]->setChecked(plotted[row]);
  }
  actions_.plots[last]->setEnabled(table.numMatrices() > 0);
  actions_.plots[last]->setChecked(!plotted.empty() && plotted.back());
}

QString MainWindow::noticeNow() const {
  if (!flash_.isEmpty()) return flash_;
  if (!hover_.isEmpty()) return hover_;
  if (const QString chosen = selectionText(); !chosen.isEmpty()) return chosen;
  if (!current_ || liveShown_) return {};
  if (const Gap* gap = current_->gapAt(playback_.positionS()))
    return "gap of " + QString::number(gap->seconds, 'f', 1) + " s: nothing was recorded";
  const auto gaps = current_->timingNow().gaps.size();
  if (gaps == 1) return "1 gap";
  return gaps == 0 ? QString() : QString::number(gaps) + " gaps";
}

void MainWindow::updateStatus() {
  if (liveShown_) return updateLiveStatus();
  Status now;
  const QString opening = opener_.busy() ? " · opening another" : "";
  if (!current_) {
    now.state = live_.state() == LiveController::State::kConnecting
                    ? "connecting: " + describe(live_.connection())
                : opener_.busy() ? "opening a recording"
                                 : "nothing open";
    now.figures.clear();
    now.notice = flash_.isEmpty() ? "Connect a hand (Ctrl+K) or open a recording (Ctrl+O)" : flash_;
    now.right = "F1 shows all keys";
  } else {
    const bool playing = playback_.playing();
    const bool inGap = current_->gapAt(playback_.positionS()) != nullptr;
    now.lamp = inGap ? Status::Lamp::kWarning : playing ? Status::Lamp::kGood : Status::Lamp::kIdle;
    now.state = "playback · " + QString(playing ? "playing " : "paused ") +
                QString::number(playback_.speed()) + "×" + (filteredShown() ? " · filtered" : "") +
                opening;
    if (playback_.hasFrames()) {
      const std::size_t frame = playback_.frame();
      const CharacteristicSignals all = shown_->at(frame, shown_->numMatrices());
      now.figures = {"active " + QString::number(all.active),
                     "max " + QString::number(all.maximum, 'f', 0),
                     "saturated " + QString::number(saturatedNow())};
      now.right = "frame " + QString::number(frame) + " of " +
                  QString::number(playback_.numFrames()) + "   " + seconds(playback_.positionS());
    }
    now.notice = noticeNow();
  }
  status_->setStatus(now);
}

void MainWindow::flash(const QString& notice) {
  flash_ = notice;
  activity_.add(LogLine::Severity::kInfo, notice);
  flashTimer_.start();
  updateStatus();
}

// The start page stands alone: docks without content would only be in the way. A recording and what is
// connected have a layout each.
void MainWindow::setPlace(Place place) {
  if (placed_ && place == place_) return;
  if (placed_ && place_ != Place::kStart) layouts_[place_] = saveState();
  const bool library = !libraryDock_->isHidden();
  const bool log = !logDock_->isHidden();
  placed_ = true;
  place_ = place;
  const bool there = place != Place::kStart;
  stack_->setCurrentIndex(there ? 1 : 0);
  charts_->setCurrentIndex(place == Place::kLive ? 1 : 0);
  playbackBar_->setVisible(place == Place::kRecording);
  menus_->setPlaybackShown(place != Place::kLive);
  if (there) {
    if (layouts_[place].isEmpty() || !restoreState(layouts_[place])) defaultLayout();
  } else {
    for (Dock* dock : docks_) dock->hide();
  }
  for (Dock* dock : docks_) dock->toggleViewAction()->setEnabled(there || staysEverywhere(dock));
  libraryDock_->setVisible(library);
  logDock_->setVisible(log);
}

// An operator has the hand at his left hand; an analyst asks for it.
void MainWindow::placeDocks(Place place) {
  const bool live = place == Place::kLive;
  addDockWidget(live ? Qt::LeftDockWidgetArea : Qt::RightDockWidgetArea, handDock_);
  addDockWidget(Qt::RightDockWidgetArea, inspectDock_);
  addDockWidget(Qt::RightDockWidgetArea, linkDock_);
  addDockWidget(Qt::RightDockWidgetArea, filterDock_);
  addDockWidget(Qt::BottomDockWidgetArea, timelineDock_);
  tabifyDockWidget(inspectDock_, linkDock_);
  tabifyDockWidget(inspectDock_, filterDock_);
  if (!live) tabifyDockWidget(inspectDock_, handDock_);
  placeLibrary();
  for (Dock* dock : docks_) {
    if (staysEverywhere(dock)) continue;
    dock->setFloating(false);
    dock->setVisible(live || (dock != handDock_ && dock != linkDock_ && dock != filterDock_));
  }
  placeSpectrum();
  calibrate_->place();
  slip_->place();
  inspectDock_->raise();
}

void MainWindow::defaultLayout() {
  if (place_ == Place::kStart) {
    layouts_.clear();
    return;
  }
  placeDocks(place_);
  const double share = place_ == Place::kLive ? kLiveInspectShare : kInspectShare;
  const int narrowest = place_ == Place::kLive ? kNarrowestLiveInspect : kNarrowestInspect;
  const int inspect = std::max(narrowest, static_cast<int>(width() * share));
  resizeDocks({inspectDock_}, {inspect}, Qt::Horizontal);
  if (place_ == Place::kLive) resizeDocks({handDock_}, {kHandWidth}, Qt::Horizontal);
  resizeDocks(
      {timelineDock_}, {static_cast<int>(height() * kMainWindowViewTimelineShare)}, Qt::Vertical);
}

void MainWindow::enableActions() {
  const bool frames = playback_.hasFrames() && !liveShown_;
  for (QAction* action : {actions_.play,
                          actions_.stepBack,
                          actions_.stepForward,
                          actions_.tenBack,
                          actions_.tenForward,
                          actions_.toStart,
                          actions_.toEnd,
                          actions_.goToFrame})
    action->setEnabled(frames);
  for (QAction* action : {actions_.zoomIn, actions_.zoomOut, actions_.fit})
    action->setEnabled(frames || liveShown_);
  for (QAction* action :
       {actions_.exportPicture, actions_.exportAgain, actions_.copyPicture, actions_.copyTable})
    action->setEnabled(somethingIsShown());
  const bool connected = live_.source() != nullptr;
  actions_.disconnectHand->setEnabled(live_.state() != LiveController::State::kNone);
  actions_.live->setEnabled(connected);
  actions_.live->setChecked(liveShown_);
  actions_.hold->setEnabled(liveShown_);
  actions_.record->setEnabled(connected);
  // The space bar and the digits: marks while live is shown, playback else.
  actions_.mark->setEnabled(liveShown_);
  for (QAction* label : actions_.labels) label->setEnabled(liveShown_);
  actions_.closeRecording->setEnabled(current_ && !liveShown_);
  enableEventActions();
  for (QAction* action : {actions_.nextRecording, actions_.previousRecording})
    action->setEnabled(recordings().size() > 1);
}

// One thing at a time, the most urgent first.
void MainWindow::dismiss() {
  if (QWidget* field = focusWidget()) field->clearFocus();
  if (!alarmStrip_->isHidden()) return alarmStrip_->hide();
  if (!banner_->isHidden()) return banner_->dismiss();
  if (opener_.busy()) return opener_.cancel();
  if (takeAway_->busy()) return takeAway_->cancel();
  if (job_.busy()) return job_.cancel();
  if (spectrum_->cancel() || calibrate_->cancel() || slip_->cancel()) return;
  if (live_.state() == LiveController::State::kConnecting) return live_.end();
  if (!matrices_->view().selection().empty()) return matrices_->view().clearSelection();
  if (timeline_->selection() && !liveShown_) return timeline_->setSelection(std::nullopt);
  if (compareShown()) return showCompare(false);
  if (isFullScreen()) toggleFullScreen(false);
}

MatricesPictureOptions MainWindow::exportOptions() const {
  MatricesPictureOptions options = matrices_->pictureOptions();
  if (liveShown_) {
    options.title = describe(live_.connection()) + filteredCaption();
    options.caption = QDateTime::fromMSecsSinceEpoch(matrices_->frame().hostUs / kUsPerMs)
                          .toString("yyyy-MM-dd HH:mm:ss.zzz");
    return options;
  }
  options.title = QString::fromStdString(current_->path.filename().string()) + filteredCaption();
  options.caption = "frame " + QString::number(playback_.frame()) + " · " +
                    seconds(current_->timeAt(playback_.frame()));
  return options;
}

QStringList MainWindow::dockNames() const {
  QStringList names;
  for (const Dock* dock : docks_) names.append(dock->objectName());
  return names;
}

void MainWindow::showDock(const QString& name) {
  for (Dock* dock : docks_) {
    if (dock->objectName() != name) continue;
    dock->show();
    dock->raise();
    if (dock == spectrumDock_) makeRoomForSpectrum();
    calibrate_->makeRoomFor(dock);
    slip_->makeRoomFor(dock);
  }
}

void MainWindow::remember() {
  showCompare(false);  // its layout is not to be remembered
  view_.speed = playback_.speed();
  if (!loopIsOfDemo_) view_.loop = playback_.loop();
  view_.skipGaps = playback_.skipGaps();
  saveViewSettings(view_, settings_);
  rememberLibrary();
  savePlottedExtras(extras_, settings_);
  rememberSession();
  saveHandLook(handPanel_->look(), settings_);
  settings_.setValue("window/views", views_->saveState());
  settings_.setValue("window/geometry", saveGeometry());
  if (place_ != Place::kStart) layouts_[place_] = saveState();
  settings_.setValue("window/layout", layouts_[Place::kRecording]);
  settings_.setValue("window/live_layout", layouts_[Place::kLive]);
  settings_.sync();
}

// What is connected is ended first, beside the window: a hand that moves is stopped, a recording finished.
void MainWindow::closeEvent(QCloseEvent* event) {
  // Everything is asked before anything is given up.
  const auto mayClose = [this] {
    return (!live_.recording() || askToEndRecording()) && settleUnsaved(recordings());
  };
  if (!closing_ && !mayClose()) return event->ignore();
  if (live_.state() == LiveController::State::kNone) {
    editors_.clear();  // what wasn't saved was discarded
    remember();
    opener_.cancel();
    return event->accept();
  }
  event->ignore();
  if (closing_) return;
  closing_ = true;
  remember();
  offer_->say("Closing: the hand is let go, a recording is finished …");
  live_.end();
}

void MainWindow::endNow() {
  askToEndRecording = [] { return true; };
  askAboutUnsaved = [](const QString&) { return Unsaved::kSave; };
  if (QWidget* dialog = QApplication::activeModalWidget()) dialog->close();
  close();
}

void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  enableActions();
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  menus_->setCompact(event->size().width() < kMainWindowViewCompactBelow);
}

}  // namespace palpate::gui

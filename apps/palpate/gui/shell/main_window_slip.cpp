#include "gui/shell/main_window_slip.h"

#include "gui/slip/slip_chart.h"
#include "gui/slip/slip_controls.h"
#include "gui/slip/slip_panel.h"
#include "gui/space/hand_panel.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

constexpr double kArrowS = 0.3;                 // the arrows' span of time
constexpr int kMainWindowSlipUsualWidth = 620;  // [px] list and drawing stand beside each other

}  // namespace

MainWindow::SlipView::SlipView(MainWindow& window) : QObject(&window), window_(window) {
  panel_ = new SlipPanel(window.settings_, &window);
  dock_ = new Dock("Slip", panel_, nullptr, &window);
  dock_->toggleViewAction()->setShortcut(QKeySequence("Ctrl+Shift+S"));
  window.docks_.append(dock_);
}

void MainWindow::SlipView::place() {
  window_.addDockWidget(Qt::RightDockWidgetArea, dock_);
  window_.tabifyDockWidget(window_.inspectDock_, dock_);
  dock_->hide();
}

void MainWindow::SlipView::connectAll() {
  MainWindow& window = window_;
  connect(panel_, &SlipPanel::said, &window, &MainWindow::flash);
  connect(panel_, &SlipPanel::foundChanged, &window, &MainWindow::showEvents);
  connect(panel_, &SlipPanel::foundChanged, this, &SlipView::showArrows);
  connect(panel_, &SlipPanel::frameChanged, this, &SlipView::showArrows);
  connect(panel_, &SlipPanel::sought, &window.playback_, &PlaybackController::seekSeconds);
  connect(&window.playback_, &PlaybackController::positionChanged, panel_, &SlipPanel::setPosition);
  connect(window.timeline_, &TimelineChart::seenChanged, this, [this] {
    const QCPRange seen = window_.timeline_->seen();
    panel_->setSeen(seen.lower, seen.upper);
  });
  connect(panel_, &SlipPanel::liveOptionsChanged, this, &SlipView::tellStage);
  connect(panel_, &SlipPanel::liveReferenceAsked, this, [this] {
    if (const LiveSource* source = window_.live_.source()) source->slip->setReference();
    window_.flash("slip is measured from this frame on");
  });
  connect(window.actions_.slipReference, &QAction::triggered, this, [this] {
    if (dock_->isHidden()) window_.showDock(dock_->objectName());
    panel_->setReference();
  });
  connect(dock_->toggleViewAction(), &QAction::triggered, this, [this](bool shown) {
    if (!shown) return;
    dock_->raise();
    makeRoomFor(dock_);
  });
}

// Asked for, it is to be read.
void MainWindow::SlipView::makeRoomFor(const Dock* asked) {
  if (asked != dock_) return;
  QTimer::singleShot(0, this, [this] {
    if (dock_->isFloating() || dock_->width() >= kMainWindowSlipUsualWidth) return;
    window_.resizeDocks({dock_}, {kMainWindowSlipUsualWidth}, Qt::Horizontal);
  });
}

void MainWindow::SlipView::show() {
  panel_->setSource(window_.current_, window_.liveShown_);
  window_.actions_.slipReference->setEnabled(window_.somethingIsShown());
  panel_->setTheme(resolved(window_.view_.theme));
  panel_->setMap(window_.view_.map);
  if (window_.liveShown_) return;
  liveOf_ = nullptr;
  const QCPRange seen = window_.timeline_->seen();
  panel_->setSeen(seen.lower, seen.upper);
  panel_->setPosition(window_.playback_.positionS());
}

bool MainWindow::SlipView::cancel() { return panel_->cancel(); }

void MainWindow::SlipView::leave() { delete dock_; }

void MainWindow::SlipView::addSlips(std::vector<EventMark>& marks) const {
  if (window_.liveShown_ || panel_->source() != window_.current_ || !panel_->found()) return;
  palpate::gui::addSlips(*panel_->found(), *window_.current_, marks);
}

void MainWindow::SlipView::showLive(const LiveResults& results) {
  const LiveSource* source = window_.live_.source();
  if (!source || results.slip.empty()) return;
  if (liveOf_ != source->history.get()) {
    liveOf_ = source->history.get();
    panel_->setLiveHand(source->session->device().hand());
    tellStage();
  }
  panel_->showLive(*results.frame, results.slip);
}

void MainWindow::SlipView::renewHand(const HandDescription& hand) { panel_->renewLiveHand(hand); }

// The alarm of what is live is the contest's, whatever gives the vector.
void MainWindow::SlipView::tellStage() {
  const LiveSource* source = window_.live_.source();
  if (!source || !window_.liveShown_) return;
  SlipDetectorOptions options = detectorOptions(panel_->controls().options());
  options.contestAlarm = true;
  source->slip->setOptions(options);
}

// The contacts' last moments, as arrows on the hand.
void MainWindow::SlipView::showArrows() {
  std::vector<HandSlip> slips;
  const SlipSeries* series = panel_->found();
  for (std::size_t m = 0; series && m < series->matrices.size(); ++m) {
    const SlipSample* now = series->at(m, panel_->frame());
    if (now == nullptr) continue;
    const RecentSlip recent = series->recent(m, panel_->frame(), kArrowS);
    if (recent.steps == 0) continue;
    slips.push_back({.matrix = m,
                     .x = static_cast<double>(now->x),
                     .y = static_cast<double>(now->y),
                     .dx = recent.dx,
                     .dy = recent.dy,
                     .turnDeg = recent.turnDeg,
                     .slipping = now->slipping});
  }
  window_.handPanel_->view().setSlip(std::move(slips));
}

ExportedView MainWindow::SlipView::exported() {
  ExportedView view;
  view.name = "Slip";
  view.widget = panel_;
  view.isThere = [this] { return panel_->shown(); };
  view.fileName = [this] { return window_.recordingStem() + "_slip"; };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    panel_->paint(painter, look, window_.exportOptions().title);
  };
  view.tables = [this] { return panel_->tables(); };
  return view;
}

}  // namespace palpate::gui

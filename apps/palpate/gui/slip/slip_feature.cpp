#include "gui/slip/slip_feature.h"

#include <utility>

#include "gui/slip/slip_chart.h"
#include "gui/slip/slip_controls.h"
#include "gui/slip/slip_panel.h"
#include "gui/widgets/content_scroll.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

constexpr double kArrowS = 0.3;       // [s] time span of the arrows
constexpr int kSlipUsualWidth = 620;  // [px] list and drawing fit side by side

}  // namespace

SlipFeature::SlipFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      reference_(windowState.actions.make("slipReference", "Analysis", "Measure s&lip from here")),
      panel_(new SlipPanel(windowState.settings, window)) {
  dock_ = new Dock("Slip", new ContentScroll(panel_, kMinDockContent), nullptr, window);
  reference_->setToolTip("Use the frame shown as the slip reference");
  connectBench();
  // The next connection may have its history at the same address.
  connect(&windowState.live, &LiveController::ended, this, [this] { liveOf_ = nullptr; });
  connect(panel_, &SlipPanel::said, &windowState.messages, &Messages::flash);
  connect(panel_, &SlipPanel::foundChanged, &windowState.events, &EventController::renewMarks);
  connect(panel_, &SlipPanel::foundChanged, this, &SlipFeature::showArrows);
  connect(panel_, &SlipPanel::frameChanged, this, &SlipFeature::showArrows);
  connect(
      panel_, &SlipPanel::seekRequested, &windowState.playback, &PlaybackController::seekSeconds);
  connect(panel_, &SlipPanel::liveOptionsChanged, this, &SlipFeature::setUpStage);
  connect(panel_, &SlipPanel::liveReferenceRequested, this, [&windowState] {
    if (const LiveSource* source = windowState.live.source()) source->slip->setReference();
    windowState.messages.flash("slip is measured from this frame on");
  });
  on(reference_, [this] {
    if (dock_->isHidden()) emit dockRequested(dock_);
    panel_->setReference();
  });
  windowState.actionEnabler.add({reference_},
                                [&windowState] { return windowState.currentFrame.hasFrame(); });
  windowState.events.addFound(
      [this](const OpenedRecordingPtr& recording, std::vector<EventMark>& marks) {
        if (panel_->source() == recording && panel_->found())
          addSlips(*panel_->found(), *recording, marks);
      });
  windowState.escapeHandler.add(EscapeHandler::Order::kComputation,
                                [this] { return panel_->cancel(); });
}

void SlipFeature::connectBench() {
  WindowState& windowState = state();
  connect(&windowState.displayed, &DisplayedSource::changed, this, &SlipFeature::takeSource);
  connect(&windowState.displayed, &DisplayedSource::handChanged, this, [this, &windowState] {
    panel_->renewLiveHand(*windowState.displayed.hand());
  });
  connect(&windowState.currentFrame, &CurrentFrame::resultsReceived, this, &SlipFeature::showLive);
  connect(
      &windowState.playback, &PlaybackController::positionChanged, panel_, &SlipPanel::setPosition);
  connect(&windowState.selection, &Selection::visibleSpanChanged, this, [this, &windowState] {
    panel_->setVisibleRange(windowState.selection.visibleSpan().fromS,
                            windowState.selection.visibleSpan().toS);
  });
  connect(&windowState.appearance, &ViewAppearance::changed, this, &SlipFeature::takeLook);
}

void SlipFeature::takeSource() {
  const DisplayedSource& displayed = state().displayed;
  panel_->setSource(displayed.unfilteredRecording(), displayed.isLive());
  if (displayed.isLive()) return;
  liveOf_ = nullptr;
  panel_->setVisibleRange(state().selection.visibleSpan().fromS,
                          state().selection.visibleSpan().toS);
  panel_->setPosition(state().playback.positionS());
}

void SlipFeature::takeLook() { panel_->setMap(state().appearance.view().map); }

void SlipFeature::showLive(const LiveResults& results) {
  const LiveSource* source = state().live.source();
  if (!source || results.slip.empty()) return;
  if (liveOf_ != source->history.get()) {
    liveOf_ = source->history.get();
    panel_->setLiveHand(source->session->device().hand());
    setUpStage();
  }
  panel_->showLive(*results.frame, results.slip);
}

// Sets the options of the live stage. Its alarm always uses the test of hypotheses,
// whichever method measures the motion.
void SlipFeature::setUpStage() {
  const LiveSource* source = state().displayed.source();
  if (!source) return;
  SlipDetectorOptions options = detectorOptions(panel_->controls().options());
  options.hypothesisAlarm = true;
  source->slip->setOptions(options);
}

// Shows the latest motion of the contacts as arrows on the hand in 3-D.
void SlipFeature::showArrows() {
  std::vector<HandSlip> slips;
  const SlipSeries* series = panel_->found();
  for (std::size_t m = 0; series && m < series->matrices.size(); ++m) {
    const SlipSample* now = series->at(m, panel_->frame());
    if (now == nullptr) continue;
    const RecentSlip recent = series->recent(m, panel_->frame(), kArrowS);
    // What the dock calls invalid has no length either.
    if (recent.steps == 0 || now->state == SlipState::kInvalid) continue;
    slips.push_back({.matrix = m,
                     .x = static_cast<double>(now->x),
                     .y = static_cast<double>(now->y),
                     .dx = recent.dx,
                     .dy = recent.dy,
                     .turnDeg = recent.turnDeg,
                     .slipping = now->slipping});
  }
  state().derivedResults.setSlips(std::move(slips));
}

void SlipFeature::settle() { panel_->settle(); }

std::vector<DockSpec> SlipFeature::docks() {
  return {{.dock = dock_,
           .key = QKeySequence("Ctrl+Shift+S"),
           .menu = "Analysis",
           .tab = 7,
           .preferredWidthPx = kSlipUsualWidth}};
}

std::vector<ExportedView> SlipFeature::views() {
  ExportedView view;
  view.name = "Slip";
  view.minHeightShare = kChartHeight;
  view.widget = panel_;
  view.isThere = [this] { return panel_->shown(); };
  view.fileName = [this] { return state().recordingStem() + "_slip"; };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    panel_->paint(painter, look, state().pictureTitle());
  };
  view.tables = [this] { return panel_->tables(); };
  return {view};
}

}  // namespace palpate::gui

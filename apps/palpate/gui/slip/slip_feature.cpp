#include "gui/slip/slip_feature.h"

#include <utility>

#include "gui/slip/slip_chart.h"
#include "gui/slip/slip_controls.h"
#include "gui/slip/slip_panel.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

constexpr double kArrowS = 0.3;       // the arrows' span of time
constexpr int kSlipUsualWidth = 620;  // [px] list and drawing stand beside each other

}  // namespace

SlipFeature::SlipFeature(Bench& bench, QWidget* window)
    : Feature(bench, window),
      reference_(
          bench.actions.make("slipReference", "View", "Slip is measured &from here", {key("O")})),
      panel_(new SlipPanel(bench.settings, window)) {
  dock_ = new Dock("Slip", panel_, nullptr, window);
  reference_->setToolTip("The frame that is shown becomes the reference of slip (O)");
  connectBench();
  connect(panel_, &SlipPanel::said, &bench.messages, &Messages::flash);
  connect(panel_, &SlipPanel::foundChanged, &bench.events, &EventDesk::renewMarks);
  connect(panel_, &SlipPanel::foundChanged, this, &SlipFeature::showArrows);
  connect(panel_, &SlipPanel::frameChanged, this, &SlipFeature::showArrows);
  connect(panel_, &SlipPanel::sought, &bench.playback, &PlaybackController::seekSeconds);
  connect(panel_, &SlipPanel::liveOptionsChanged, this, &SlipFeature::setUpStage);
  connect(panel_, &SlipPanel::liveReferenceAsked, this, [&bench] {
    if (const LiveSource* source = bench.live.source()) source->slip->setReference();
    bench.messages.flash("slip is measured from this frame on");
  });
  on(reference_, [this] {
    if (dock_->isHidden()) emit dockAsked(dock_);
    panel_->setReference();
  });
  bench.enabling.add({reference_}, [&bench] { return bench.moment.hasFrame(); });
  bench.events.addFound([this](const OpenedRecordingPtr& recording, std::vector<EventMark>& marks) {
    if (panel_->source() == recording && panel_->found())
      addSlips(*panel_->found(), *recording, marks);
  });
  bench.escape.add(Escape::Order::kComputation, [this] { return panel_->cancel(); });
}

void SlipFeature::connectBench() {
  Bench& bench = this->bench();
  connect(&bench.subject, &Subject::changed, this, &SlipFeature::takeSource);
  connect(&bench.subject, &Subject::handChanged, this, [this, &bench] {
    panel_->renewLiveHand(*bench.subject.hand());
  });
  connect(&bench.moment, &Moment::resultsCame, this, &SlipFeature::showLive);
  connect(&bench.playback, &PlaybackController::positionChanged, panel_, &SlipPanel::setPosition);
  connect(&bench.selection, &Selection::inSightChanged, this, [this, &bench] {
    panel_->setSeen(bench.selection.inSight().fromS, bench.selection.inSight().toS);
  });
  connect(&bench.look, &ViewLook::changed, this, &SlipFeature::takeLook);
}

void SlipFeature::takeSource() {
  const Subject& subject = bench().subject;
  panel_->setSource(subject.behind(), subject.isLive());
  if (subject.isLive()) return;
  liveOf_ = nullptr;
  panel_->setSeen(bench().selection.inSight().fromS, bench().selection.inSight().toS);
  panel_->setPosition(bench().playback.positionS());
}

void SlipFeature::takeLook() {
  panel_->setTheme(bench().look.theme());
  panel_->setMap(bench().look.view().map);
}

void SlipFeature::showLive(const LiveResults& results) {
  const LiveSource* source = bench().live.source();
  if (!source || results.slip.empty()) return;
  if (liveOf_ != source->history.get()) {
    liveOf_ = source->history.get();
    panel_->setLiveHand(source->session->device().hand());
    setUpStage();
  }
  panel_->showLive(*results.frame, results.slip);
}

// The alarm of what is live is the contest's, whatever gives the vector.
void SlipFeature::setUpStage() {
  const LiveSource* source = bench().subject.source();
  if (!source) return;
  SlipDetectorOptions options = detectorOptions(panel_->controls().options());
  options.contestAlarm = true;
  source->slip->setOptions(options);
}

// The contacts' last moments, as arrows on the hand.
void SlipFeature::showArrows() {
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
  bench().overlays.setSlips(std::move(slips));
}

void SlipFeature::settle() { panel_->settle(); }

std::vector<DockOffer> SlipFeature::docks() {
  return {
      {.dock = dock_, .key = QKeySequence("Ctrl+Shift+S"), .tab = 7, .roomPx = kSlipUsualWidth}};
}

std::vector<ExportedView> SlipFeature::views() {
  ExportedView view;
  view.name = "Slip";
  view.widget = panel_;
  view.isThere = [this] { return panel_->shown(); };
  view.fileName = [this] { return bench().recordingStem() + "_slip"; };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    panel_->paint(painter, look, bench().pictureTitle());
  };
  view.tables = [this] { return panel_->tables(); };
  return {view};
}

}  // namespace palpate::gui

#include "gui/compare/compare_feature.h"

#include <algorithm>

#include "gui/compare/compare_chart.h"
#include "gui/compare/compare_panel.h"

namespace palpate::gui {
namespace {

constexpr const char* kAlignmentKey = "compare/alignment";
constexpr const char* kOverlayKey = "compare/overlay";
constexpr const char* kBandKey = "compare/band";

}  // namespace

CompareFeature::CompareFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      action_(windowState.actions.make(
          "compare", "Analysis", "Compare two recordin&gs…", {key("Ctrl+Shift+C")}, true)),
      panel_(new ComparePanel(action_,
                              windowState.actions.at("interpolated"),
                              windowState.actions.at("values"),
                              window)) {
  const std::string last = windowState.settings.value(kAlignmentKey).toString().toStdString();
  if (const auto known = alignmentFrom(last))
    if (*known != Alignment::kManual) panel_->setAlignment(*known);
  for (const CompareOverlay each : kAllCompareOverlays)
    if (windowState.settings.value(kOverlayKey).toString() == nameOf(each))
      panel_->setOverlay(each);
  for (const CompareBand each : kAllCompareBands)
    if (windowState.settings.value(kBandKey).toString() == nameOf(each)) panel_->setBand(each);
  panel_->setEvents([&windowState](const OpenedRecordingPtr& recording) {
    return windowState.events.eventsOf(recording);
  });
  connectPanel();
  connectBench();
}

void CompareFeature::connectPanel() {
  WindowState& windowState = state();
  connect(panel_, &ComparePanel::seekRequested, this, &CompareFeature::seek);
  connect(panel_, &ComparePanel::aChosen, &windowState.displayed, &DisplayedSource::show);
  connect(panel_,
          &ComparePanel::swapRequested,
          this,
          [this, &windowState](const OpenedRecordingPtr& recording, double seconds) {
            const bool playing = windowState.playback.playing();
            windowState.displayed.show(recording);
            seek(seconds);
            if (playing) windowState.playback.play();
          });
  connect(panel_, &ComparePanel::openRequested, this, [&windowState] {
    // A is kept: the recording that is opened here becomes B.
    windowState.askAndOpen(windowState.displayed.unfilteredRecording()
                               ? OpenRequest::Then::kList
                               : OpenRequest::Then::kShowFirst);
  });
  connect(panel_, &ComparePanel::signalChosen, this, [&windowState](PlottedSignal signal) {
    windowState.appearance.change([&](ViewSettings& view) { view.signal = signal; });
  });
  connect(panel_, &ComparePanel::alignmentChanged, this, [this, &windowState] {
    if (panel_->alignment() != Alignment::kManual)
      windowState.settings.setValue(
          kAlignmentKey, QString::fromStdString(std::string(nameOf(panel_->alignment()))));
  });
  connect(panel_, &ComparePanel::overlayChanged, this, [this, &windowState] {
    windowState.settings.setValue(kOverlayKey, nameOf(panel_->overlay()));
    windowState.settings.setValue(kBandKey, nameOf(panel_->band()));
  });
  connect(panel_, &ComparePanel::hovered, &windowState.messages, &Messages::hover);
}

void CompareFeature::connectBench() {
  WindowState& windowState = state();
  on(action_, [this](bool on) { show(on); });
  const auto list = [this, &windowState] {
    panel_->setRecordings(windowState.recordings.all(),
                          windowState.displayed.unfilteredRecording());
  };
  connect(&windowState.comparison,
          &ComparisonMode::bChosen,
          this,
          [this, list](const OpenedRecordingPtr& b) {
            list();
            panel_->setB(b);
          });
  connect(&windowState.comparison, &ComparisonMode::changed, this, [this, &windowState](bool on) {
    action_->setChecked(on);
    if (on) panel_->setTime(windowState.playback.positionS());
    panel_->setActive(on);
  });
  connect(
      &windowState.playback, &PlaybackController::positionChanged, panel_, &ComparePanel::setTime);
  connect(&windowState.recordings, &OpenRecordings::arrived, this, list);
  connect(&windowState.displayed, &DisplayedSource::changed, this, list);
  connect(&windowState.appearance, &ViewAppearance::changed, this, [this, &windowState] {
    panel_->setSettings(windowState.appearance.view());
  });
  windowState.escapeHandler.add(EscapeHandler::Order::kCompare, [&windowState] {
    if (!windowState.comparison.on()) return false;
    windowState.comparison.set(false);
    return true;
  });
}

void CompareFeature::start() {
  panel_->setRecordings(state().recordings.all(), state().displayed.unfilteredRecording());
}

// Where A has ended, B may still have frames; the playback then waits at A's end.
void CompareFeature::seek(double seconds) {
  PlaybackController& playback = state().playback;
  const double within = std::clamp(seconds, 0.0, playback.durationS());
  if (within != seconds) playback.pause();
  playback.seekSeconds(within);
  panel_->setTime(seconds);
}

void CompareFeature::show(bool on) {
  if (!on || state().displayed.isRecording()) return state().comparison.set(on);
  // Without a recording there is nothing to compare: the one that is opened now is compared.
  action_->setChecked(false);
  state().askAndOpen(OpenRequest::Then::kCompare);
}

std::vector<CentralViewSpec> CompareFeature::centre() {
  return {{CentralViewSpec::Where::kInstead, panel_}};
}

std::vector<ExportedView> CompareFeature::views() {
  WindowState& windowState = state();
  ExportedView view;
  view.name = "Compare";
  view.rank = 3;
  view.widget = panel_;
  view.minHeightShare = 2 * kChartHeight;  // heat maps above the chart
  view.isThere = [this, &windowState] { return windowState.comparison.on() && panel_->hasPair(); };
  view.fileName = [this, &windowState] {
    return windowState.recordingStem() + "_and_" +
           QString::fromStdString(panel_->b()->path.stem().string());
  };
  view.paint = [this](QPainter& painter, const PictureLook& look) { panel_->paint(painter, look); };
  view.tables = [this] {
    std::vector<ExportedTable> tables = {
        {"differences of the frame", [table = panel_->differenceTable()] { return table; }},
        {"curves of both", [table = panel_->curveTable()] { return table; }}};
    if (panel_->hasAverage())
      tables.push_back(
          {"the average and its curves", [table = panel_->averageTable()] { return table; }});
    return tables;
  };
  return {view};
}

}  // namespace palpate::gui

#include "gui/compare/compare_feature.h"

#include <algorithm>

#include "gui/compare/compare_chart.h"
#include "gui/compare/compare_panel.h"

namespace palpate::gui {
namespace {

constexpr const char* kAlignmentKey = "compare/alignment";

}  // namespace

CompareFeature::CompareFeature(Bench& bench, QWidget* window)
    : Feature(bench, window),
      action_(bench.actions.make(
          "compare", "View", "Com&pare two recordings…", {key("Ctrl+Shift+C")}, true)),
      panel_(new ComparePanel(
          action_, bench.actions.at("interpolated"), bench.actions.at("values"), window)) {
  const std::string last = bench.settings.value(kAlignmentKey).toString().toStdString();
  if (const auto known = alignmentFrom(last))
    if (*known != Alignment::kByHand) panel_->setAlignment(*known);
  connectPanel();
  connectBench();
}

void CompareFeature::connectPanel() {
  Bench& bench = this->bench();
  connect(panel_, &ComparePanel::sought, this, &CompareFeature::seek);
  connect(panel_, &ComparePanel::aChosen, &bench.subject, &Subject::show);
  connect(panel_,
          &ComparePanel::swapAsked,
          this,
          [this, &bench](const OpenedRecordingPtr& recording, double seconds) {
            const bool playing = bench.playback.playing();
            bench.subject.show(recording);
            seek(seconds);
            if (playing) bench.playback.play();
          });
  connect(panel_, &ComparePanel::openAsked, this, [&bench] {
    // A stays: what is opened here is to be B.
    bench.askAndOpen(bench.subject.behind() ? OpenRequest::Then::kList
                                            : OpenRequest::Then::kShowFirst);
  });
  connect(panel_, &ComparePanel::signalChosen, this, [&bench](PlottedSignal signal) {
    bench.look.change([&](ViewSettings& view) { view.signal = signal; });
  });
  connect(panel_, &ComparePanel::alignmentChanged, this, [this, &bench] {
    if (panel_->alignment() != Alignment::kByHand)
      bench.settings.setValue(kAlignmentKey,
                              QString::fromStdString(std::string(nameOf(panel_->alignment()))));
  });
  connect(panel_, &ComparePanel::hovered, &bench.messages, &Messages::hover);
}

void CompareFeature::connectBench() {
  Bench& bench = this->bench();
  on(action_, [this](bool on) { show(on); });
  const auto list = [this, &bench] {
    panel_->setRecordings(bench.recordings.all(), bench.subject.behind());
  };
  connect(&bench.comparing, &Comparing::bChosen, this, [this, list](const OpenedRecordingPtr& b) {
    list();
    panel_->setB(b);
  });
  connect(&bench.comparing, &Comparing::changed, this, [this, &bench](bool on) {
    action_->setChecked(on);
    if (on) panel_->setTime(bench.playback.positionS());
    panel_->setActive(on);
  });
  connect(&bench.playback, &PlaybackController::positionChanged, panel_, &ComparePanel::setTime);
  connect(&bench.recordings, &OpenRecordings::arrived, this, list);
  connect(&bench.subject, &Subject::changed, this, list);
  connect(&bench.look, &ViewLook::changed, this, [this, &bench] {
    panel_->setSettings(bench.look.view(), bench.look.theme());
  });
  bench.escape.add(Escape::Order::kCompare, [&bench] {
    if (!bench.comparing.on()) return false;
    bench.comparing.set(false);
    return true;
  });
}

void CompareFeature::start() {
  panel_->setRecordings(bench().recordings.all(), bench().subject.behind());
}

// Where A has no frame any more B may still have one: then the playback waits at A's end.
void CompareFeature::seek(double seconds) {
  PlaybackController& playback = bench().playback;
  const double within = std::clamp(seconds, 0.0, playback.durationS());
  if (within != seconds) playback.pause();
  playback.seekSeconds(within);
  panel_->setTime(seconds);
}

void CompareFeature::show(bool on) {
  if (!on || bench().subject.isRecording()) return bench().comparing.set(on);
  // Nothing to compare yet: what is opened now will be.
  action_->setChecked(false);
  bench().askAndOpen(OpenRequest::Then::kCompare);
}

std::vector<CentreOffer> CompareFeature::centre() {
  return {{CentreOffer::Where::kInstead, panel_}};
}

std::vector<ExportedView> CompareFeature::views() {
  Bench& bench = this->bench();
  ExportedView view;
  view.name = "Compare";
  view.rank = 3;
  view.widget = panel_;
  view.isThere = [this, &bench] { return bench.comparing.on() && panel_->hasPair(); };
  view.fileName = [this, &bench] {
    return bench.recordingStem() + "_and_" +
           QString::fromStdString(panel_->b()->path.stem().string());
  };
  view.paint = [this](QPainter& painter, const PictureLook& look) { panel_->paint(painter, look); };
  view.tables = [this] {
    return std::vector<ExportedTable>{
        {"differences of the frame", [table = panel_->differenceTable()] { return table; }},
        {"curves of both", [table = panel_->curveTable()] { return table; }}};
  };
  return {view};
}

}  // namespace palpate::gui

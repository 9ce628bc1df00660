#include "gui/spectrum/spectrum_feature.h"

#include "gui/spectrum/spectrum_panel.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

constexpr double kShareOfHeight = 0.31;  // of the window's, when it is asked for

}  // namespace

SpectrumFeature::SpectrumFeature(Bench& bench, QWidget* window)
    : Feature(bench, window), panel_(new SpectrumPanel(bench.settings, window)) {
  dock_ = new Dock("Spectrum", panel_, &panel_->header(), window);
  connect(&bench.subject, &Subject::shown, this, &SpectrumFeature::takeSource);
  connect(&bench.selection, &Selection::taxelsChanged, this, &SpectrumFeature::takeTaxels);
  connect(&bench.selection, &Selection::inSightChanged, this, &SpectrumFeature::takeSight);
  connect(&bench.look, &ViewLook::changed, this, &SpectrumFeature::takeLook);
  connect(
      &bench.playback, &PlaybackController::positionChanged, panel_, &SpectrumPanel::setPosition);
  connect(panel_, &SpectrumPanel::said, &bench.messages, &Messages::flash);
  connectChart();
  bench.escape.add(Escape::Order::kComputation, [this] { return panel_->cancel(); });
}

void SpectrumFeature::connectChart() {
  Selection& selection = bench().selection;
  SpectrumChart& chart = panel_->chart();
  connect(&chart, &SpectrumChart::sought, &bench().playback, &PlaybackController::seekSeconds);
  connect(&chart, &SpectrumChart::fitAsked, &selection, &Selection::showAll);
  connect(&chart, &SpectrumChart::zoomAsked, &selection, &Selection::zoomAbout);
  connect(&chart, &SpectrumChart::panAsked, this, [&selection](double seconds) {
    const TimeSpan seen = selection.inSight();
    selection.show({seen.fromS + seconds, seen.toS + seconds});
  });
}

void SpectrumFeature::takeSource() {
  panel_->setSource(bench().subject.seen(), bench().subject.isLive());
  takeTaxels();
  takeLook();
  takeSight();
  panel_->setPosition(bench().playback.positionS());
}

void SpectrumFeature::takeTaxels() {
  if (!bench().subject.isLive()) panel_->setTaxels(bench().selection.taxels());
}

void SpectrumFeature::takeSight() {
  const TimeSpan& seen = bench().selection.inSight();
  panel_->setSeen(seen.fromS, seen.toS);
}

void SpectrumFeature::takeLook() {
  panel_->setMap(bench().look.view().map);
  panel_->setTheme(bench().look.theme());
}

void SpectrumFeature::settle() { panel_->settle(); }

std::vector<DockOffer> SpectrumFeature::docks() {
  return {{.dock = dock_,
           .key = QKeySequence("Ctrl+U"),
           .area = Qt::BottomDockWidgetArea,
           .liveArea = Qt::BottomDockWidgetArea,
           .above = true,
           .shareOfHeight = kShareOfHeight}};
}

std::vector<ExportedView> SpectrumFeature::views() {
  ExportedView view;
  view.name = "Spectrum";
  view.widget = panel_;
  view.isThere = [this] { return panel_->shown(); };
  view.fileName = [this] { return bench().recordingStem() + "_spectrum"; };
  view.size = [this] { return QSizeF(panel_->chart().size()); };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    panel_->chart().paint(painter, look, bench().pictureTitle(), panel_->name());
  };
  view.tables = [this] { return panel_->tables(); };
  return {view};
}

}  // namespace palpate::gui

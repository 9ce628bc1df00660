#include "gui/spectrum/spectrum_feature.h"

#include "gui/spectrum/spectrum_panel.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

constexpr double kShareOfHeight = 0.31;  // of the window's height, when the dock is opened

}  // namespace

SpectrumFeature::SpectrumFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window), panel_(new SpectrumPanel(windowState.settings, window)) {
  dock_ = new Dock("Spectrum", panel_, &panel_->header(), window);
  connect(&windowState.displayed, &DisplayedSource::shown, this, &SpectrumFeature::takeSource);
  connect(&windowState.selection, &Selection::taxelsChanged, this, &SpectrumFeature::takeTaxels);
  connect(
      &windowState.selection, &Selection::visibleSpanChanged, this, &SpectrumFeature::takeSight);
  connect(&windowState.selection, &Selection::spanChanged, this, [this] {
    panel_->setSpan(state().selection.span());
  });
  connect(&windowState.appearance, &ViewAppearance::changed, this, &SpectrumFeature::takeLook);
  connect(&windowState.playback,
          &PlaybackController::positionChanged,
          panel_,
          &SpectrumPanel::setPosition);
  connect(panel_, &SpectrumPanel::said, &windowState.messages, &Messages::flash);
  const auto takeFormulas = [this, &windowState] {
    panel_->setFormulas(windowState.formulas.all());
  };
  connect(&windowState.formulas, &FormulaCurves::changed, this, takeFormulas);
  takeFormulas();
  connectChart();
  windowState.escapeHandler.add(EscapeHandler::Order::kComputation,
                                [this] { return panel_->cancel(); });
}

void SpectrumFeature::connectChart() {
  Selection& selection = state().selection;
  SpectrumChart& chart = panel_->chart();
  connect(
      &chart, &SpectrumChart::seekRequested, &state().playback, &PlaybackController::seekSeconds);
  connect(
      &chart, &SpectrumChart::rightChanged, &state().appearance, &ViewAppearance::setTimeAxisRight);
  connect(&chart, &SpectrumChart::fitRequested, &selection, &Selection::showAll);
  connect(&chart, &SpectrumChart::zoomRequested, &selection, &Selection::zoomAbout);
  connect(&chart, &SpectrumChart::panRequested, this, [&selection](double seconds) {
    const TimeSpan seen = selection.visibleSpan();
    selection.show({seen.fromS + seconds, seen.toS + seconds});
  });
}

void SpectrumFeature::takeSource() {
  panel_->setSource(state().displayed.filteredRecording(), state().displayed.isLive());
  takeTaxels();
  takeLook();
  takeSight();
  panel_->setSpan(state().selection.span());
  panel_->setPosition(state().playback.positionS());
}

void SpectrumFeature::takeTaxels() {
  if (!state().displayed.isLive()) panel_->setTaxels(state().selection.taxels());
}

void SpectrumFeature::takeSight() {
  const TimeSpan& seen = state().selection.visibleSpan();
  panel_->setVisibleRange(seen.fromS, seen.toS);
}

void SpectrumFeature::takeLook() { panel_->setMap(state().appearance.view().map); }

void SpectrumFeature::settle() { panel_->settle(); }

std::vector<DockSpec> SpectrumFeature::docks() {
  return {{.dock = dock_,
           .key = QKeySequence("Ctrl+U"),
           .menu = "Analysis",
           .area = Qt::BottomDockWidgetArea,
           .liveArea = Qt::BottomDockWidgetArea,
           .above = true,
           .shareOfHeight = kShareOfHeight}};
}

std::vector<ExportedView> SpectrumFeature::views() {
  ExportedView view;
  view.name = "Spectrum";
  view.minHeightShare = kChartHeight;
  view.widget = panel_;
  view.isThere = [this] { return panel_->shown(); };
  view.fileName = [this] { return state().recordingStem() + "_spectrum"; };
  view.size = [this] { return panel_->chartSize(); };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    panel_->paint(painter, look, state().pictureTitle());
  };
  view.tables = [this] { return panel_->tables(); };
  return {view};
}

}  // namespace palpate::gui

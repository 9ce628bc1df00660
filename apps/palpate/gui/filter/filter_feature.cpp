#include "gui/filter/filter_feature.h"

#include "gui/filter/filter_panel.h"
#include "gui/widgets/content_scroll.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

// Short names for a row of buttons: "0d".
QStringList matrixNamesOf(const HandDescription& hand) {
  QStringList names;
  for (const MatrixDescription& matrix : hand.matrices)
    names.append(QString::fromStdString(matrix.shortName).section(' ', 0, 0) +
                 QString::fromStdString(matrix.shortName).section(' ', 1, 1).left(1));
  return names;
}

}  // namespace

FilterFeature::FilterFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      action_(windowState.actions.make("filtered", "View", "Apply &filters", {}, true)),
      panel_(new FilterPanel(windowState.activeFilters.editor(), windowState.ask, window)) {
  dock_ = new Dock("Filter", new ContentScroll(panel_, kMinDockContent), nullptr, window);
  ActiveFilters& activeFilters = windowState.activeFilters;
  action_->setToolTip("Show data after or before filtering");
  panel_->setOn(activeFilters.on());
  action_->setChecked(activeFilters.on());
  on(action_, [&activeFilters](bool on) { activeFilters.setOn(on); });
  connect(panel_, &FilterPanel::onChanged, &activeFilters, &ActiveFilters::setOn);
  connect(&activeFilters, &ActiveFilters::onChanged, this, [this](bool on) {
    panel_->setOn(on);
    action_->setChecked(on);
  });
  connect(&activeFilters, &ActiveFilters::sourceChanged, this, &FilterFeature::takeSource);
  connect(&activeFilters, &ActiveFilters::progressed, panel_, &FilterPanel::showProgress);
  connect(&activeFilters, &ActiveFilters::measured, panel_, &FilterPanel::showFigures);
  connect(&activeFilters, &ActiveFilters::failed, panel_, &FilterPanel::showFailure);
  connect(panel_, &FilterPanel::message, &windowState.messages, &Messages::flash);
  connect(panel_, &FilterPanel::keepRequested, &activeFilters, &ActiveFilters::keepWithRecording);
  connect(&windowState.live, &LiveController::refreshed, this, [this, &windowState] {
    if (windowState.live.source() && !dock_->isHidden())
      panel_->showFigures(windowState.activeFilters.liveFigures());
  });
}

void FilterFeature::takeSource() {
  const DisplayedSource& displayed = state().displayed;
  if (displayed.isLive())
    panel_->setSource(matrixNamesOf(*displayed.hand()), state().live.health().frames.rateHz, true);
  else if (displayed.isRecording())
    panel_->setSource(matrixNamesOf(*displayed.hand()),
                      displayed.unfilteredRecording()->timingNow().rateHz,
                      false);
  panel_->setKeepable(displayed.isRecording());
}

std::vector<DockSpec> FilterFeature::docks() {
  return {{.dock = dock_, .key = QKeySequence("Ctrl+Shift+F"), .tab = 2}};
}

}  // namespace palpate::gui

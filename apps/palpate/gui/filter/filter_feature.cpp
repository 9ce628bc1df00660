#include "gui/filter/filter_feature.h"

#include "gui/filter/filter_panel.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

// As short as buttons in a row are: "0d".
QStringList matrixNamesOf(const HandDescription& hand) {
  QStringList names;
  for (const MatrixDescription& matrix : hand.matrices)
    names.append(QString::fromStdString(matrix.shortName).section(' ', 0, 0) +
                 QString::fromStdString(matrix.shortName).section(' ', 1, 1).left(1));
  return names;
}

}  // namespace

FilterFeature::FilterFeature(Bench& bench, QWidget* window)
    : Feature(bench, window),
      action_(
          bench.actions.make("filtered", "View", "&Filtered, or as recorded", {key("A")}, true)),
      panel_(new FilterPanel(bench.filtering.editor(), window)) {
  dock_ = new Dock("Filter", panel_, nullptr, window);
  Filtering& filtering = bench.filtering;
  action_->setToolTip("After the filters, or before (A)");
  panel_->setOn(filtering.on());
  action_->setChecked(filtering.on());
  on(action_, [&filtering](bool on) { filtering.setOn(on); });
  connect(panel_, &FilterPanel::onChanged, &filtering, &Filtering::setOn);
  connect(&filtering, &Filtering::onChanged, this, [this](bool on) {
    panel_->setOn(on);
    action_->setChecked(on);
  });
  connect(&filtering, &Filtering::sourceChanged, this, &FilterFeature::takeSource);
  connect(&filtering, &Filtering::progressed, panel_, &FilterPanel::showProgress);
  connect(&filtering, &Filtering::measured, panel_, &FilterPanel::showFigures);
  connect(&filtering, &Filtering::failed, panel_, &FilterPanel::showFailure);
  connect(panel_, &FilterPanel::told, &bench.messages, &Messages::flash);
  connect(panel_, &FilterPanel::keepAsked, &filtering, &Filtering::keepWithRecording);
  connect(&bench.live, &LiveController::looked, this, [this, &bench] {
    if (bench.live.source() && !dock_->isHidden())
      panel_->showFigures(bench.filtering.liveFigures());
  });
}

void FilterFeature::takeSource() {
  const Subject& subject = bench().subject;
  if (subject.isLive())
    panel_->setSource(matrixNamesOf(*subject.hand()), bench().live.health().frames.rateHz, true);
  else if (subject.isRecording())
    panel_->setSource(matrixNamesOf(*subject.hand()), subject.behind()->timingNow().rateHz, false);
  panel_->setKeepable(subject.isRecording());
}

std::vector<DockOffer> FilterFeature::docks() {
  return {{.dock = dock_, .key = QKeySequence("Ctrl+Shift+F"), .tab = 2, .shownLive = true}};
}

}  // namespace palpate::gui

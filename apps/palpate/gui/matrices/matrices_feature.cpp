#include "gui/matrices/matrices_feature.h"

#include <QMenu>
#include <set>

#include <palpate/recording/table_export.h>

#include "gui/appearance/color_map.h"
#include "gui/appearance/icons.h"
#include "gui/appearance/window_settings.h"
#include "gui/matrices/matrices_frame_painter.h"
#include "gui/matrices/matrices_painter.h"
#include "gui/matrices/matrices_panel.h"

namespace palpate::gui {

MatricesActions::MatricesActions(ActionRegistry& book) {
  interpolated = book.make("interpolated", "View", "&Smooth", {}, true);
  interpolated->setToolTip("Smooth: interpolate the colours between taxels");
  values = book.make("values", "View", "&Values", {}, true);
  values->setToolTip("Values: print the value of each active taxel");
  scanOnly = book.make("scanOnly", "Hand", "Scan &only the chosen taxels");
  scanOnly->setToolTip("No taxel of the other matrices is scanned: the most frames per second");
  scanOnlyInTheirMatrices = book.make(
      "scanOnlyInTheirMatrices", "Hand", "Scan only the chosen taxels of these &matrices", {});
  scanOnlyInTheirMatrices->setToolTip("The other matrices stay as they are");
  scanWithout = book.make("scanWithout", "Hand", "&Leave out the chosen taxels");
  scanAlso = book.make("scanAlso", "Hand", "Scan the chosen taxels, &too");
  scanAll = book.make("scanAll", "Hand", "Scan &all taxels");
  chooseNone = book.make("chooseNone", "Hand", "Deselect all ta&xels");
  QStringList names;
  for (const ColorMapName map : kAllColorMaps) names.append(nameOf(map));
  maps = book.choices("maps", names);
  names.clear();
  for (const RangeMode mode : kAllRangeModes) names.append(nameOf(mode));
  ranges = book.choices("ranges", names);
  interpolated->setIconText(" " + plainText(*interpolated));
  values->setIconText(" " + plainText(*values));
  interpolated->setIcon(makeIcon(IconShape::kInterpolated));
  values->setIcon(makeIcon(IconShape::kValues));
}

MatricesFeature::MatricesFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      actions_(windowState.actions),
      panel_(new MatricesPanel(actions_.interpolated, actions_.values, window)),
      scan_(windowState, actions_) {
  DisplayedSource& displayed = windowState.displayed;
  connect(
      &displayed, &DisplayedSource::filteredRecordingChanged, this, &MatricesFeature::takeSource);
  connect(&displayed, &DisplayedSource::handChanged, this, [this] {
    panel_->setHand(*this->state().displayed.hand());
    panel_->view().setUnmeasurable(this->state().derivedResults.unmeasurable());
    this->state().selection.setTaxels(panel_->view().selection());
  });
  connect(&displayed, &DisplayedSource::moreKnown, panel_, &MatricesPanel::renewRange);
  connect(&windowState.currentFrame, &CurrentFrame::frameChanged, this, [this] {
    panel_->show(this->state().currentFrame.frame());
  });
  connect(&windowState.currentFrame, &CurrentFrame::staleNoticeChanged, this, [this] {
    panel_->view().setStale(this->state().currentFrame.old());
  });
  DerivedResults& derivedResults = windowState.derivedResults;
  connect(&derivedResults, &DerivedResults::pressureChanged, this, [this, &derivedResults] {
    panel_->view().setPressure(derivedResults.pressure());
  });
  connect(&derivedResults, &DerivedResults::slipsChanged, this, [this, &derivedResults] {
    std::set<std::size_t> slipping;
    for (const HandSlip& slip : derivedResults.slips())
      if (slip.slipping) slipping.insert(slip.matrix);
    panel_->view().setSlipping(slipping);
  });
  followUnits(&panel_->view());
  connect(&derivedResults, &DerivedResults::unmeasurableChanged, this, [this, &derivedResults] {
    const std::vector<QString>& why = derivedResults.unmeasurable();
    if (this->state().displayed.isLive() || why.empty()) panel_->view().setUnmeasurable(why);
  });
  connect(&windowState.live, &LiveController::leaving, panel_, &MatricesPanel::forgetLargest);
  connectLook();
  connectChosen();
}

void MatricesFeature::takeSource() {
  const DisplayedSource& displayed = state().displayed;
  panel_->setRecording(displayed.isRecording() ? displayed.filteredRecording() : nullptr);
  if (displayed.isLive()) panel_->setHand(*displayed.hand());
  panel_->view().setUnmeasurable(displayed.isLive() ? state().derivedResults.unmeasurable()
                                                    : std::vector<QString>());
  panel_->view().setStale(state().currentFrame.old());
  // From now on the selection is one of the matrices of this hand.
  state().selection.setTaxels(panel_->view().selection());
}

void MatricesFeature::connectLook() {
  ViewAppearance& look = state().appearance;
  MatricesActions& actions = actions_;
  connect(&look, &ViewAppearance::changed, this, [this, &look, &actions] {
    panel_->setSettings(look.view());
    actions.interpolated->setChecked(look.view().interpolated);
    actions.values->setChecked(look.view().values);
    checkChoice(actions.maps, kAllColorMaps, look.view().map);
    checkChoice(actions.ranges, kAllRangeModes, look.view().range);
  });
  state().actionEnabler.add({actions.interpolated, actions.values},
                            [this] { return state().displayed.hand() != nullptr; });
  on(actions.interpolated, [&look](bool checked) {
    look.change([&](ViewSettings& view) { view.interpolated = checked; });
  });
  on(actions.values,
     [&look](bool checked) { look.change([&](ViewSettings& view) { view.values = checked; }); });
  const auto useMap = [this, &look](ColorMapName map) {
    look.change([&](ViewSettings& view) { view.map = map; });
    if (panel_->view().look().isSigned)
      state().messages.flash(
          QString("readings with a sign keep the diverging colour map; %1 is for other views")
              .arg(nameOf(map)));
  };
  const auto useRange = [&look](RangeMode range) {
    look.change([&](ViewSettings& view) { view.range = range; });
  };
  connect(actions.maps, &QActionGroup::triggered, this, [useMap](const QAction* action) {
    useMap(kAllColorMaps.at(action->data().toUInt()));
  });
  connect(actions.ranges, &QActionGroup::triggered, this, [useRange](const QAction* action) {
    useRange(kAllRangeModes.at(action->data().toUInt()));
  });
  connect(panel_, &MatricesPanel::mapChosen, this, useMap);
  connect(panel_, &MatricesPanel::rangeChosen, this, useRange);
  connect(panel_, &MatricesPanel::taxelsChosen, this, [&look](TaxelView taxels) {
    look.change([&](ViewSettings& view) { view.taxels = taxels; });
  });
  connect(panel_, &MatricesPanel::arrowsChosen, this, [&look](double arrows) {
    look.change([&](ViewSettings& view) { view.arrows = arrows; });
  });
  connect(panel_, &MatricesPanel::manualRangeChosen, this, [&look](double low, double high) {
    look.change([&](ViewSettings& view) {
      view.manualMin = low;
      view.manualMax = high;
    });
  });
}

void MatricesFeature::connectChosen() {
  MatricesView& view = panel_->view();
  Selection& selection = state().selection;
  connect(&view, &MatricesView::selectionChanged, this, [&view, &selection] {
    selection.setTaxels(view.selection());
  });
  connect(&selection, &Selection::taxelsChanged, this, [&view, &selection] {
    if (!(view.selection() == selection.taxels())) view.select(selection.taxels());
  });
  connect(&view, &MatricesView::hovered, &state().messages, &Messages::hover);
  connect(&view, &MatricesView::menuRequested, this, [this](const QPoint& at) {
    state().menus.scanned->popup(at);
  });
  state().escapeHandler.add(EscapeHandler::Order::kTaxels, [&selection] {
    if (selection.taxels().empty()) return false;
    selection.clearTaxels();
    return true;
  });
}

std::vector<CentralViewSpec> MatricesFeature::centre() {
  return {{CentralViewSpec::Where::kBeside, panel_}};
}

MatricesPictureOptions pictureOptions(const WindowState& windowState, const MatricesPanel& panel) {
  MatricesPictureOptions options = panel.pictureOptions();
  options.title = windowState.pictureTitle();
  options.caption = windowState.pictureCaption();
  return options;
}

std::vector<ExportedView> MatricesFeature::views() {
  WindowState& windowState = state();
  ExportedView view;
  view.name = "Matrices";
  view.widget = panel_;
  view.isThere = [&windowState] {
    return windowState.currentFrame.hasFrame() && !windowState.comparison.on();
  };
  view.fileName = [&windowState] { return windowState.frameStem(); };
  view.size = [this] { return QSizeF(panel_->view().size()); };
  view.hasColorBar = true;
  view.paint = [this, &windowState](QPainter& painter, const PictureLook& look) {
    paintMatricesPicture(painter,
                         QRectF(QPointF(), look.size),
                         windowState.currentFrame.frame(),
                         *windowState.displayed.hand(),
                         fitted(pictureOptions(windowState, *panel_), look));
  };
  view.tables = [&windowState] {
    const std::string frame = windowState.displayed.isLive()
                                  ? std::string()
                                  : std::to_string(windowState.playback.frame());
    return std::vector<ExportedTable>{
        {"taxels of the frame",
         [shown = windowState.currentFrame.frame(), frame] { return taxelTable(shown, frame); }}};
  };
  view.framePictures = [this, &windowState]() -> std::optional<FramePictures> {
    std::optional<FramePictures> pictures = windowState.framePictures({});
    if (!pictures) return pictures;
    const OpenedRecordingPtr recording = windowState.displayed.filteredRecording();
    MatricesPictureOptions options = pictureOptions(windowState, *panel_);
    if (windowState.appearance.view().range == RangeMode::kFrame)
      // Each frame gets its own range.
      options.rangeMax = options.rangeMin = 0.0;
    pictures->hasColorBar = true;
    pictures->painter = [recording, options](const PictureLook& look) {
      return matricesFramePainter(recording, fitted(options, look));
    };
    return pictures;
  };
  return {view};
}

}  // namespace palpate::gui

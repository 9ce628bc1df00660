#include "gui/matrices/matrices_feature.h"

#include <QMenu>
#include <utility>

#include <palpate/recording/frame_table.h>

#include "gui/look/next_choice.h"
#include "gui/matrices/matrices_frame_painter.h"
#include "gui/matrices/matrices_painter.h"
#include "gui/matrices/matrices_panel.h"

namespace palpate::gui {

MatricesFeature::MatricesFeature(Bench& bench, QWidget* window)
    : Feature(bench, window),
      actions_(bench.actions),
      panel_(new MatricesPanel(actions_.interpolated, actions_.values, window)),
      scan_(bench, actions_) {
  Subject& subject = bench.subject;
  connect(&subject, &Subject::seenChanged, this, &MatricesFeature::takeSource);
  connect(&subject, &Subject::handChanged, this, [this] {
    panel_->setHand(*this->bench().subject.hand());
    panel_->view().setBlind(this->bench().overlays.blind());
    this->bench().selection.setTaxels(panel_->view().selection());
  });
  connect(&subject, &Subject::moreKnown, panel_, &MatricesPanel::renewRange);
  connect(&bench.moment, &Moment::frameChanged, this, [this] {
    panel_->show(this->bench().moment.frame());
  });
  connect(&bench.moment, &Moment::oldChanged, this, [this] {
    panel_->view().setOld(this->bench().moment.old());
  });
  Overlays& overlays = bench.overlays;
  connect(&overlays, &Overlays::pressureChanged, this, [this, &overlays] {
    panel_->view().setPressure(overlays.pressure());
  });
  connect(&overlays, &Overlays::blindChanged, this, [this, &overlays] {
    const std::vector<QString>& why = overlays.blind();
    if (this->bench().subject.isLive() || why.empty()) panel_->view().setBlind(why);
  });
  connect(&bench.live, &LiveController::leaving, panel_, &MatricesPanel::forgetLargest);
  connectLook();
  connectChosen();
}

void MatricesFeature::takeSource() {
  const Subject& subject = bench().subject;
  panel_->setRecording(subject.isRecording() ? subject.seen() : nullptr);
  if (subject.isLive()) panel_->setHand(*subject.hand());
  panel_->view().setBlind(subject.isLive() ? bench().overlays.blind() : std::vector<QString>());
  panel_->view().setOld(bench().moment.old());
  bench().selection.setTaxels(panel_->view().selection());  // of these matrices
}

void MatricesFeature::connectLook() {
  ViewLook& look = bench().look;
  MatricesActions& actions = actions_;
  connect(&look, &ViewLook::changed, this, [this, &look, &actions] {
    panel_->setSettings(look.view(), look.theme());
    actions.interpolated->setChecked(look.view().interpolated);
    actions.values->setChecked(look.view().values);
    checkChoice(actions.maps, kAllColorMaps, look.view().map);
    checkChoice(actions.ranges, kAllRangeModes, look.view().range);
  });
  on(actions.interpolated, [&look](bool checked) {
    look.change([&](ViewSettings& view) { view.interpolated = checked; });
  });
  on(actions.values,
     [&look](bool checked) { look.change([&](ViewSettings& view) { view.values = checked; }); });
  on(actions.nextMap, [&look] {
    look.change([](ViewSettings& view) { view.map = after(kAllColorMaps, view.map); });
  });
  on(actions.nextRange, [&look] {
    look.change([](ViewSettings& view) { view.range = after(kAllRangeModes, view.range); });
  });
  const auto useMap = [&look](ColorMapName map) {
    look.change([&](ViewSettings& view) { view.map = map; });
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
  connect(panel_, &MatricesPanel::manualRangeChosen, this, [&look](double low, double high) {
    look.change([&](ViewSettings& view) {
      view.manualMin = low;
      view.manualMax = high;
    });
  });
}

void MatricesFeature::connectChosen() {
  MatricesView& view = panel_->view();
  Selection& selection = bench().selection;
  connect(&view, &MatricesView::selectionChanged, this, [&view, &selection] {
    selection.setTaxels(view.selection());
  });
  connect(&selection, &Selection::taxelsChanged, this, [&view, &selection] {
    if (!(view.selection() == selection.taxels())) view.select(selection.taxels());
  });
  connect(&view, &MatricesView::hovered, &bench().messages, &Messages::hover);
  connect(&view, &MatricesView::menuAsked, this, [this](const QPoint& at) {
    bench().menus.scanned->popup(at);
  });
  bench().escape.add(Escape::Order::kTaxels, [&selection] {
    if (selection.taxels().empty()) return false;
    selection.clearTaxels();
    return true;
  });
}

std::vector<CentreOffer> MatricesFeature::centre() {
  return {{CentreOffer::Where::kBeside, panel_}};
}

MatricesPictureOptions pictureOptions(const Bench& bench, const MatricesPanel& panel) {
  MatricesPictureOptions options = panel.pictureOptions();
  options.title = bench.pictureTitle();
  options.caption = bench.pictureCaption();
  return options;
}

std::vector<ExportedView> MatricesFeature::views() {
  Bench& bench = this->bench();
  ExportedView view;
  view.name = "Matrices";
  view.widget = panel_;
  view.isThere = [&bench] { return bench.moment.hasFrame() && !bench.comparing.on(); };
  view.fileName = [&bench] { return bench.frameStem(); };
  view.size = [this] { return QSizeF(panel_->view().size()); };
  view.paint = [this, &bench](QPainter& painter, const PictureLook& look) {
    paintMatricesPicture(painter,
                         QRectF(QPointF(), look.size),
                         bench.moment.frame(),
                         *bench.subject.hand(),
                         fitted(pictureOptions(bench, *panel_), look));
  };
  view.tables = [&bench] {
    const std::string frame =
        bench.subject.isLive() ? std::string() : std::to_string(bench.playback.frame());
    return std::vector<ExportedTable>{
        {"taxels of the frame",
         [shown = bench.moment.frame(), frame] { return taxelTable(shown, frame); }}};
  };
  view.framePictures = [this, &bench]() -> std::optional<FramePictures> {
    std::optional<FramePictures> pictures = bench.framePictures({});
    if (!pictures) return pictures;
    const OpenedRecordingPtr recording = bench.subject.seen();
    MatricesPictureOptions options = pictureOptions(bench, *panel_);
    if (bench.look.view().range == RangeMode::kFrame)
      options.rangeMax = options.rangeMin = 0.0;  // of each
    pictures->painter = [recording, options](const PictureLook& look) {
      return matricesFramePainter(recording, fitted(options, look));
    };
    return pictures;
  };
  return {view};
}

}  // namespace palpate::gui

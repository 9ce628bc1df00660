#include "gui/space/space_feature.h"

#include <QMenu>
#include <utility>

#include "gui/look/next_choice.h"
#include "gui/matrices/matrices_feature.h"
#include "gui/matrices/matrices_frame_painter.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/space/hand_frame_painter.h"
#include "gui/space/hand_panel.h"

namespace palpate::gui {
namespace {

constexpr double kTurnDeg = 10.0;    // by a key
constexpr double kMoveShare = 0.06;  // of the view's height, by a key
constexpr double kNearer = 1.2;

HandPanel* makePanel(const SpaceActions& actions, QWidget* window) {
  return new HandPanel({actions.normals,
                        actions.contacts,
                        actions.slipArrows,
                        actions.sphereOfCentroids,
                        actions.wire,
                        actions.axes},
                       window);
}

}  // namespace

SpaceFeature::SpaceFeature(Bench& bench, QWidget* window, MatricesPanel& matrices)
    : Feature(bench, window),
      actions_(bench.actions),
      matrices_(matrices),
      panel_(makePanel(actions_, window)) {
  panel_->view().setAssumedAngles(bench.surroundings.assumedAnglesDeg);
  connectMoment();
  connectLook();
  connectCamera();
}

void SpaceFeature::connectMoment() {
  Bench& bench = this->bench();
  HandView& view = panel_->view();
  connect(&bench.subject, &Subject::seenChanged, this, &SpaceFeature::takeSource);
  connect(&bench.subject, &Subject::handChanged, this, [this] {
    panel_->setHand(*this->bench().subject.hand());
  });
  connect(&bench.moment, &Moment::frameChanged, this, [this] {
    if (!this->bench().subject.isLive()) showMoment();
  });
  connect(&bench.moment, &Moment::resultsCame, this, [this](const LiveResults& results) {
    if (panel_->isHidden()) return;
    panel_->show(*results.frame, results.angles ? results.angles->deg : std::vector<double>());
  });
  connect(&bench.moment, &Moment::oldChanged, this, [&bench, &view] {
    view.setOld(bench.moment.old());
  });
  connect(&bench.overlays, &Overlays::pressureChanged, this, [&bench, &view] {
    view.setPressure(bench.overlays.pressure());
  });
  connect(&bench.overlays, &Overlays::slipsChanged, this, [&bench, &view] {
    view.setSlip(bench.overlays.slips());
  });
  // One selection, one range of colours, one text of what is under the mouse.
  connect(&matrices_, &MatricesPanel::lookChanged, panel_, &HandPanel::setColors);
  connect(&bench.selection, &Selection::taxelsChanged, this, [&bench, &view] {
    if (!(view.selection() == bench.selection.taxels())) view.select(bench.selection.taxels());
  });
  connect(&view, &HandView::selectionChanged, this, [&bench, &view] {
    bench.selection.setTaxels(view.selection());
  });
  connect(&view, &HandView::hovered, &bench.messages, &Messages::hover);
  connect(&view, &HandView::openGlFailed, this, [&bench](const QString& why) {
    bench.messages.flash("the hand is drawn without OpenGL: " + why);
  });
}

void SpaceFeature::takeSource() {
  const Subject& subject = bench().subject;
  if (subject.isLive())
    panel_->setHand(*subject.hand());
  else
    panel_->setRecording(subject.seen());
}

void SpaceFeature::showMoment() {
  const Subject& subject = bench().subject;
  if (panel_->isHidden() || !subject.isRecording() || !bench().moment.hasFrame()) return;
  if (bench().moment.damaged()) return;  // it stays as it was, and says so
  const auto& angles = bench().moment.angles();
  panel_->show(bench().moment.frame(), angles ? angles->deg : std::vector<double>());
}

void SpaceFeature::connectLook() {
  SpaceActions& actions = actions_;
  const auto tick = [this](QAction* action, bool HandLook::*part) {
    on(action, [this, part](bool yes) { changeLook([=](HandLook& look) { look.*part = yes; }); });
  };
  tick(actions.normals, &HandLook::normals);
  tick(actions.contacts, &HandLook::contacts);
  tick(actions.wire, &HandLook::wire);
  tick(actions.slipArrows, &HandLook::slip);
  tick(actions.axes, &HandLook::axes);
  on(actions.sphereOfCentroids, [this](bool yes) {
    changeLook(
        [=](HandLook& look) { look.sphereOf = yes ? SphereOf::kCentroids : SphereOf::kTaxels; });
  });
  on(actions.nextTaxelShape, [this] {
    changeLook([](HandLook& look) { look.taxels = after(kAllTaxelShapes, look.taxels); });
  });
  on(actions.nextSphere, [this] {
    changeLook([](HandLook& look) { look.sphere = after(kAllSphereLooks, look.sphere); });
  });
  for (qsizetype i = 0; i < actions.onlys.size(); ++i)
    on(actions.onlys[i], [this, i] {
      const HandDescription* hand = bench().subject.hand();
      const auto matrix = static_cast<std::size_t>(i) - 1;
      changeLook([&](HandLook& look) {
        look.only.reset();
        if (i > 0 && hand && matrix < hand->layout->numMatrices()) look.only = matrix;
      });
    });
  connect(bench().menus.only, &QMenu::aboutToShow, this, &SpaceFeature::showLook);
  connect(panel_, &HandPanel::lookChosen, this, [this](const HandLook& look) {
    changeLook([&](HandLook& now) { now = look; });
  });
  on(actions.matricesShown,
     [this](bool shown) { showViews(shown, !shown || !panel_->isHidden()); });
  on(actions.handShown, [this](bool shown) { showViews(!shown || !matrices_.isHidden(), shown); });
}

void SpaceFeature::connectCamera() {
  SpaceActions& actions = actions_;
  HandView& view = panel_->view();
  on(actions.fitHand, [&view] { view.fit(); });
  on(actions.resetHand, [&view] { view.resetCamera(); });
  on(actions.nearer, [&view] { view.zoomBy(kNearer); });
  on(actions.further, [&view] { view.zoomBy(1.0 / kNearer); });
  constexpr std::pair<double, double> kWays[] = {{-1.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}};
  for (qsizetype i = 0; i < 4; ++i) {
    const auto [right, up] = kWays[i];
    on(actions.orbits[i],
       [&view, right = right, up = up] { view.orbitBy(right * kTurnDeg, up * kTurnDeg); });
    on(actions.pans[i],
       [&view, right = right, up = up] { view.panBy(right * kMoveShare, up * kMoveShare); });
  }
}

void SpaceFeature::start() {
  QSettings& settings = bench().settings;
  panel_->setLook(loadHandLook(settings));
  panel_->setColors(matrices_.view().look());
  showViews(settings.value("window/matrices_shown", true).toBool(),
            settings.value("window/hand_shown", true).toBool());
  showLook();
}

void SpaceFeature::remember() { saveHandLook(panel_->look(), bench().settings); }

void SpaceFeature::changeLook(const std::function<void(HandLook&)>& change) {
  HandLook look = panel_->look();
  change(look);
  panel_->setLook(look);
  showLook();
}

void SpaceFeature::showLook() {
  SpaceActions& actions = actions_;
  const HandLook& look = panel_->look();
  actions.sphereOfCentroids->setChecked(look.sphereOf == SphereOf::kCentroids);
  actions.normals->setChecked(look.normals);
  actions.contacts->setChecked(look.contacts);
  actions.wire->setChecked(look.wire);
  actions.slipArrows->setChecked(look.slip);
  actions.axes->setChecked(look.axes);
  const HandDescription* hand = bench().subject.hand();
  const std::size_t count = hand ? hand->layout->numMatrices() : 0;
  for (qsizetype i = 0; i < actions.onlys.size(); ++i) {
    QAction* action = actions.onlys[i];
    const auto number = static_cast<std::size_t>(i);
    action->setVisible(number <= count || count == 0);
    if (i > 0 && number <= count)
      action->setText(QString::fromStdString(hand->matrixName(number - 1)) + " alone");
    action->setChecked(i == 0 ? !look.only : look.only == number - 1);
  }
}

// One of the two is always there.
void SpaceFeature::showViews(bool matrices, bool hand) {
  if (!matrices && !hand) matrices = true;
  matrices_.setVisible(matrices);
  const bool late = hand && panel_->isHidden();
  panel_->setVisible(hand);
  panel_->view().setColorBar(!matrices);
  actions_.matricesShown->setChecked(matrices);
  actions_.handShown->setChecked(hand);
  bench().settings.setValue("window/matrices_shown", matrices);
  bench().settings.setValue("window/hand_shown", hand);
  if (late) showMoment();
}

std::vector<CentreOffer> SpaceFeature::centre() { return {{CentreOffer::Where::kBeside, panel_}}; }

std::vector<ExportedView> SpaceFeature::views() {
  Bench& bench = this->bench();
  ExportedView view;
  view.name = "Hand";
  view.widget = panel_;
  view.isThere = [this, &bench] {
    return bench.moment.hasFrame() && !bench.comparing.on() && !panel_->isHidden();
  };
  view.fileName = [&bench] { return bench.frameStem() + "_hand"; };
  view.size = [this] { return QSizeF(panel_->view().size()); };
  view.paint = [this, &bench](QPainter& painter, const PictureLook& look) {
    const HandView& shown = panel_->view();
    const MatricesPictureOptions page = fitted(pictureOptions(bench, matrices_), look);
    paintHandPicture(
        painter, QRectF(QPointF(), look.size), shown.drawing(), shown.pictureOptions(page));
  };
  view.framePictures = [this, &bench]() -> std::optional<FramePictures> {
    std::optional<FramePictures> pictures = bench.framePictures("_hand");
    if (!pictures) return pictures;
    const OpenedRecordingPtr recording = bench.subject.seen();
    pictures->painter = [recording,
                         options = pictureOptions(bench, matrices_),
                         shown = &panel_->view()](const PictureLook& look) {
      return handFramePainter(
          recording->profile, shown->pictureOptions(fitted(options, look)), shown->assumedAngles());
    };
    return pictures;
  };
  return {view};
}

}  // namespace palpate::gui

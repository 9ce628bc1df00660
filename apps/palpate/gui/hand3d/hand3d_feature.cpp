#include "gui/hand3d/hand3d_feature.h"

#include <QMenu>
#include <utility>

#include "gui/hand3d/hand_frame_painter.h"
#include "gui/hand3d/hand_panel.h"
#include "gui/matrices/matrices_feature.h"
#include "gui/matrices/matrices_frame_painter.h"
#include "gui/matrices/matrices_panel.h"

namespace palpate::gui {

Hand3dActions::Hand3dActions(ActionRegistry& book) {
  const char* space = "Hand in 3-D";
  matricesShown = book.make("matricesShown", "View", "Show the &matrices", {}, true);
  handShown = book.make("handShown", "View", "Show the &hand in 3-D", {}, true);
  QStringList names;
  for (const TaxelShape shape : kAllTaxelShapes) names.append(nameOf(shape));
  taxelShapes = book.choices("taxelShapes", names);
  names.clear();
  for (const SphereLook look : kAllSphereLooks) names.append(nameOf(look));
  spheres = book.choices("spheres", names);
  sphereOfCentroids =
      book.make("sphereOfCentroids", space, "Sphere around the c&entroids", {}, true);
  normals = book.make("normals", space, "&Normals of the taxels", {}, true);
  contacts = book.make("contacts", space, "&Contacts: centroids, axes, directions", {}, true);
  wire = book.make("wire", space, "&Wire frame", {}, true);
  axes = book.make("axes", space, "&Axes of the hand's base", {}, true);
  slipArrows = book.make("slipArrows", space, "S&lip: how contacts and object move", {}, true);
  fitHand = book.make("fitHand", space, "Fit it into the &picture");
  resetHand = book.make("resetHand", space, "&Back to the default view");
  nearer = book.make("nearer", space, "Nea&rer");
  further = book.make("further", space, "&Further");
  for (const char* way : {"Left", "Right", "Up", "Down"})
    orbits.append(book.add(
        "orbits", space, "Turn " + QString(way).toLower(), {QKeySequence("Ctrl+" + QString(way))}));
  for (const char* way : {"Left", "Right", "Up", "Down"})
    pans.append(book.add("pans", space, "Move " + QString(way).toLower()));
  onlys.append(book.add("onlys", space, "The whole hand", {}, true));
  for (int i = 0; i < ActionRegistry::kListedMatrices; ++i)
    onlys.append(book.add("onlys", space, "Matrix " + QString::number(i) + " alone", {}, true));
  setKind(orbits, "Ctrl+arrows", "Turn it");
}

namespace {

// Turn by one key press.
constexpr double kTurnDeg = 10.0;
// Movement by one key press, as a share of the height of the view.
constexpr double kMoveShare = 0.06;
constexpr double kNearer = 1.2;

HandPanel* makePanel(const Hand3dActions& actions, QWidget* window) {
  return new HandPanel({actions.normals,
                        actions.contacts,
                        actions.slipArrows,
                        actions.sphereOfCentroids,
                        actions.wire,
                        actions.axes},
                       window);
}

}  // namespace

Hand3dFeature::Hand3dFeature(WindowState& windowState, QWidget* window, MatricesPanel& matrices)
    : Feature(windowState, window),
      actions_(windowState.actions),
      matrices_(matrices),
      panel_(makePanel(actions_, window)) {
  panel_->view().setAssumedAngles(windowState.environment.assumedAnglesDeg);
  connectMoment();
  connectLook();
  connectCamera();
}

void Hand3dFeature::connectMoment() {
  WindowState& windowState = state();
  HandView& view = panel_->view();
  connect(&windowState.displayed,
          &DisplayedSource::filteredRecordingChanged,
          this,
          &Hand3dFeature::takeSource);
  connect(&windowState.displayed, &DisplayedSource::handChanged, this, [this] {
    panel_->setHand(*this->state().displayed.hand());
  });
  connect(&windowState.currentFrame, &CurrentFrame::frameChanged, this, [this] {
    if (!this->state().displayed.isLive()) showMoment();
  });
  connect(&windowState.currentFrame,
          &CurrentFrame::resultsReceived,
          this,
          [this, &windowState, &view](const LiveResults& results) {
            if (panel_->isHidden()) return;
            if (const auto objects = windowState.live.objects()) view.setObjects(*objects);
            panel_->showLive(*results.frame,
                             results.angles ? results.angles->values : std::vector<double>());
          });
  connect(
      &windowState.currentFrame, &CurrentFrame::staleNoticeChanged, this, [&windowState, &view] {
        view.setStale(windowState.currentFrame.old());
      });
  connect(
      &windowState.derivedResults, &DerivedResults::pressureChanged, this, [&windowState, &view] {
        view.setPressure(windowState.derivedResults.pressure());
      });
  followUnits(&view);
  connect(&windowState.derivedResults, &DerivedResults::slipsChanged, this, [&windowState, &view] {
    view.setSlip(windowState.derivedResults.slips());
  });
  // Both views share selection, colour range and the text of the taxel under the mouse pointer.
  connect(&matrices_, &MatricesPanel::lookChanged, panel_, &HandPanel::setColors);
  connect(&windowState.selection, &Selection::taxelsChanged, this, [&windowState, &view] {
    if (!(view.selection() == windowState.selection.taxels()))
      view.select(windowState.selection.taxels());
  });
  connect(&view, &HandView::selectionChanged, this, [&windowState, &view] {
    windowState.selection.setTaxels(view.selection());
  });
  connect(&view, &HandView::hovered, &windowState.messages, &Messages::hover);
  connect(&view, &HandView::openGlFailed, this, [&windowState](const QString& why) {
    windowState.messages.flash("the hand is drawn without OpenGL: " + why);
  });
}

void Hand3dFeature::takeSource() {
  const DisplayedSource& displayed = state().displayed;
  if (displayed.isLive())
    panel_->setHand(*displayed.hand());
  else
    panel_->setRecording(displayed.filteredRecording());
}

void Hand3dFeature::showMoment() {
  const DisplayedSource& displayed = state().displayed;
  if (panel_->isHidden() || !displayed.isRecording() || !state().currentFrame.hasFrame()) return;
  // The view stays as it was and shows the notice.
  if (state().currentFrame.damaged()) return;
  const auto& angles = state().currentFrame.angles();
  panel_->show(state().currentFrame.frame(), angles ? angles->values : std::vector<double>());
}

void Hand3dFeature::connectLook() {
  Hand3dActions& actions = actions_;
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
  connect(actions.taxelShapes, &QActionGroup::triggered, this, [this](const QAction* chosen) {
    changeLook([=](HandLook& look) { look.taxels = kAllTaxelShapes.at(chosen->data().toUInt()); });
  });
  connect(actions.spheres, &QActionGroup::triggered, this, [this](const QAction* chosen) {
    changeLook([=](HandLook& look) { look.sphere = kAllSphereLooks.at(chosen->data().toUInt()); });
  });
  for (qsizetype i = 0; i < actions.onlys.size(); ++i)
    on(actions.onlys[i], [this, i] {
      const HandDescription* hand = state().displayed.hand();
      const auto matrix = static_cast<std::size_t>(i) - 1;
      changeLook([&](HandLook& look) {
        look.only.reset();
        if (i > 0 && hand && matrix < hand->layout->numMatrices()) look.only = matrix;
      });
    });
  connect(state().menus.only, &QMenu::aboutToShow, this, &Hand3dFeature::showLook);
  connect(panel_, &HandPanel::lookChosen, this, [this](const HandLook& look) {
    changeLook([&](HandLook& now) { now = look; });
  });
  on(actions.matricesShown,
     [this](bool shown) { showViews(shown, !shown || !panel_->isHidden()); });
  on(actions.handShown, [this](bool shown) { showViews(!shown || !matrices_.isHidden(), shown); });
}

void Hand3dFeature::connectCamera() {
  Hand3dActions& actions = actions_;
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

void Hand3dFeature::start() {
  QSettings& settings = state().settings;
  panel_->setLook(loadHandLook(settings));
  panel_->setColors(matrices_.view().look());
  showViews(settings.value("window/matrices_shown", true).toBool(),
            settings.value("window/hand_shown", true).toBool());
  showLook();
}

void Hand3dFeature::remember() { saveHandLook(panel_->look(), state().settings); }

void Hand3dFeature::changeLook(const std::function<void(HandLook&)>& change) {
  HandLook look = panel_->look();
  change(look);
  panel_->setLook(look);
  showLook();
}

void Hand3dFeature::showLook() {
  Hand3dActions& actions = actions_;
  const HandLook& look = panel_->look();
  checkChoice(actions.taxelShapes, kAllTaxelShapes, look.taxels);
  checkChoice(actions.spheres, kAllSphereLooks, look.sphere);
  actions.sphereOfCentroids->setChecked(look.sphereOf == SphereOf::kCentroids);
  actions.normals->setChecked(look.normals);
  actions.contacts->setChecked(look.contacts);
  actions.wire->setChecked(look.wire);
  actions.slipArrows->setChecked(look.slip);
  actions.axes->setChecked(look.axes);
  const HandDescription* hand = state().displayed.hand();
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

// One of the two views is always visible.
void Hand3dFeature::showViews(bool matrices, bool hand) {
  if (!matrices && !hand) matrices = true;
  matrices_.setVisible(matrices);
  const bool late = hand && panel_->isHidden();
  panel_->setVisible(hand);
  panel_->view().setColorBar(!matrices);
  actions_.matricesShown->setChecked(matrices);
  actions_.handShown->setChecked(hand);
  state().settings.setValue("window/matrices_shown", matrices);
  state().settings.setValue("window/hand_shown", hand);
  if (late) showMoment();
}

std::vector<CentralViewSpec> Hand3dFeature::centre() {
  return {{CentralViewSpec::Where::kBeside, panel_}};
}

std::vector<ExportedView> Hand3dFeature::views() {
  WindowState& windowState = state();
  ExportedView view;
  view.name = "Hand";
  view.widget = panel_;
  view.isThere = [this, &windowState] {
    return windowState.currentFrame.hasFrame() && !windowState.comparison.on() &&
           !panel_->isHidden();
  };
  view.fileName = [&windowState] { return windowState.frameStem() + "_hand"; };
  view.size = [this] { return QSizeF(panel_->view().size()); };
  view.hasColorBar = true;
  view.paint = [this, &windowState](QPainter& painter, const PictureLook& look) {
    const HandView& shown = panel_->view();
    const MatricesPictureOptions page = fitted(pictureOptions(windowState, matrices_), look);
    paintHandPicture(
        painter, QRectF(QPointF(), look.size), shown.drawing(), shown.pictureOptions(page));
  };
  view.framePictures = [this, &windowState]() -> std::optional<FramePictures> {
    std::optional<FramePictures> pictures = windowState.framePictures("_hand");
    if (!pictures) return pictures;
    const OpenedRecordingPtr recording = windowState.displayed.filteredRecording();
    pictures->hasColorBar = true;
    pictures->painter = [recording,
                         options = pictureOptions(windowState, matrices_),
                         shown = &panel_->view()](const PictureLook& look) {
      return handFramePainter(
          recording->profile, shown->pictureOptions(fitted(options, look)), shown->assumedAngles());
    };
    return pictures;
  };
  return {view};
}

}  // namespace palpate::gui

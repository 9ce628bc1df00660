// The hand in space within the main window: what is shown beside it, shared with the heat maps, taken away.
#include <QMenu>
#include <utility>

#include "gui/export/take_away.h"
#include "gui/look/next_choice.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/shell/main_window.h"
#include "gui/space/frame_painters.h"
#include "gui/space/hand_panel.h"

namespace palpate::gui {
namespace {

constexpr double kTurnDeg = 10.0;    // by a key
constexpr double kMoveShare = 0.06;  // of the view's height, by a key
constexpr double kNearer = 1.2;

}  // namespace

void MainWindow::connectHandView() {
  const auto on = [this](QAction* action, auto what) {
    connect(action, &QAction::triggered, this, what);
  };
  HandView& view = handPanel_->view();
  on(actions_.matricesShown,
     [this](bool shown) { showViews(shown, !shown || !handPanel_->isHidden()); });
  on(actions_.handShown,
     [this](bool shown) { showViews(!shown || !matrices_->isHidden(), shown); });
  on(actions_.nextTaxelShape, [this] {
    changeHand([](HandLook& look) { look.taxels = after(kAllTaxelShapes, look.taxels); });
  });
  on(actions_.nextSphere, [this] {
    changeHand([](HandLook& look) { look.sphere = after(kAllSphereLooks, look.sphere); });
  });
  on(actions_.sphereOfCentroids, [this](bool yes) {
    changeHand(
        [=](HandLook& look) { look.sphereOf = yes ? SphereOf::kCentroids : SphereOf::kTaxels; });
  });
  on(actions_.normals,
     [this](bool yes) { changeHand([=](HandLook& look) { look.normals = yes; }); });
  on(actions_.contacts,
     [this](bool yes) { changeHand([=](HandLook& look) { look.contacts = yes; }); });
  on(actions_.wire, [this](bool yes) { changeHand([=](HandLook& look) { look.wire = yes; }); });
  on(actions_.slipArrows,
     [this](bool yes) { changeHand([=](HandLook& look) { look.slip = yes; }); });
  on(actions_.axes, [this](bool yes) { changeHand([=](HandLook& look) { look.axes = yes; }); });
  on(actions_.fitHand, [&view] { view.fit(); });
  on(actions_.resetHand, [&view] { view.resetCamera(); });
  on(actions_.nearer, [&view] { view.zoomBy(kNearer); });
  on(actions_.further, [&view] { view.zoomBy(1.0 / kNearer); });
  constexpr std::pair<double, double> kWays[] = {{-1.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}};
  for (qsizetype i = 0; i < 4; ++i) {
    const auto [right, up] = kWays[i];
    on(actions_.orbits[i],
       [&view, right = right, up = up] { view.orbitBy(right * kTurnDeg, up * kTurnDeg); });
    on(actions_.pans[i],
       [&view, right = right, up = up] { view.panBy(right * kMoveShare, up * kMoveShare); });
  }
  for (qsizetype i = 0; i < actions_.onlys.size(); ++i)
    on(actions_.onlys[i], [this, i] {
      const HandDescription* hand = matrices_->hand();
      const auto matrix = static_cast<std::size_t>(i) - 1;
      changeHand([&](HandLook& look) {
        look.only.reset();
        if (i > 0 && hand && matrix < hand->layout->numMatrices()) look.only = matrix;
      });
    });
  connect(menus_->only, &QMenu::aboutToShow, this, &MainWindow::showHandLook);
  connect(handPanel_, &HandPanel::lookChosen, this, [this](const HandLook& look) {
    changeHand([&](HandLook& now) { now = look; });
  });
  // One selection, one range of colours, one text of what is under the mouse.
  connect(matrices_, &MatricesPanel::lookChanged, handPanel_, &HandPanel::setColors);
  connect(&matrices_->view(), &MatricesView::selectionChanged, this, [this] {
    handPanel_->view().select(matrices_->view().selection());
  });
  connect(&view, &HandView::selectionChanged, this, [this] {
    matrices_->view().select(handPanel_->view().selection());
  });
  connect(&view, &HandView::hovered, this, [this](const QString& text) {
    hover_ = text;
    updateStatus();
  });
  connect(&view, &HandView::openGlFailed, this, [this](const QString& why) {
    flash("the hand is drawn without OpenGL: " + why);
  });
  handPanel_->setLook(loadHandLook(settings_));
  handPanel_->setColors(matrices_->view().look());
  if (!views_->restoreState(settings_.value("window/views").toByteArray()))
    views_->setSizes({1000, 1000});
  showViews(settings_.value("window/matrices_shown", true).toBool(),
            settings_.value("window/hand_shown", true).toBool());
  showHandLook();
}

void MainWindow::changeHand(const std::function<void(HandLook&)>& change) {
  HandLook look = handPanel_->look();
  change(look);
  handPanel_->setLook(look);
  showHandLook();
}

void MainWindow::showHandLook() {
  const HandLook& look = handPanel_->look();
  actions_.sphereOfCentroids->setChecked(look.sphereOf == SphereOf::kCentroids);
  actions_.normals->setChecked(look.normals);
  actions_.contacts->setChecked(look.contacts);
  actions_.wire->setChecked(look.wire);
  actions_.slipArrows->setChecked(look.slip);
  actions_.axes->setChecked(look.axes);
  const HandDescription* hand = matrices_->hand();
  const std::size_t count = hand ? hand->layout->numMatrices() : 0;
  for (qsizetype i = 0; i < actions_.onlys.size(); ++i) {
    QAction* action = actions_.onlys[i];
    const auto number = static_cast<std::size_t>(i);
    action->setVisible(number <= count || count == 0);
    if (i > 0 && number <= count)
      action->setText(QString::fromStdString(hand->matrixName(number - 1)) + " alone");
    action->setChecked(i == 0 ? !look.only : look.only == number - 1);
  }
}

// One of the two is always there.
void MainWindow::showViews(bool matrices, bool hand) {
  if (!matrices && !hand) matrices = true;
  matrices_->setVisible(matrices);
  const bool late = hand && handPanel_->isHidden();
  handPanel_->setVisible(hand);
  handPanel_->view().setColorBar(!matrices);
  actions_.matricesShown->setChecked(matrices);
  actions_.handShown->setChecked(hand);
  settings_.setValue("window/matrices_shown", matrices);
  settings_.setValue("window/hand_shown", hand);
  if (late && current_ && !liveShown_ && playback_.hasFrames()) showFrame(playback_.frame());
}

ExportedView MainWindow::handExport() {
  ExportedView view;
  view.name = "Hand";
  view.widget = handPanel_;
  view.isThere = [this] {
    return somethingIsShown() && !compareShown() && !handPanel_->isHidden();
  };
  view.fileName = [this] { return pictureName() + "_hand"; };
  view.size = [this] { return QSizeF(handPanel_->view().size()); };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    const HandView& shown = handPanel_->view();
    paintHandPicture(painter,
                     QRectF(QPointF(), look.size),
                     shown.drawing(),
                     shown.pictureOptions(fitted(exportOptions(), look)));
  };
  view.framePictures = [this]() -> std::optional<FramePictures> {
    if (liveShown_ || !current_) return std::nullopt;
    FramePictures pictures;
    pictures.fileName = recordingStem() + "_hand";
    pictures.numFrames = current_->profile.numFrames();
    if (takeAway_->selectedFrames) pictures.selected = takeAway_->selectedFrames();
    pictures.timeUs = [recording = shown_](std::size_t frame) {
      return recording->profile.frameTimeUs(frame);
    };
    pictures.painter = [recording = shown_, options = exportOptions(), shown = &handPanel_->view()](
                           const PictureLook& look) {
      return handFramePainter(
          recording->profile, shown->pictureOptions(fitted(options, look)), shown->assumedAngles());
    };
    return pictures;
  };
  return view;
}

}  // namespace palpate::gui

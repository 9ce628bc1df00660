#include "gui/shell/show_scene.h"

#include "gui/hand3d/hand_view.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/matrices/matrices_view.h"
#include "gui/widgets/make.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

ShowScene::ShowScene(WindowState& windowState, MatricesPanel& panel, QWidget* parent)
    : QWidget(parent),
      windowState_(windowState),
      panel_(panel),
      hand_(new HandView(this)),
      matrices_(new MatricesView(this)) {
  setLayout(inRow({{hand_, 1}, {matrices_, 1}}, Space::kNone));
  // Keys belong to the window.
  hand_->setFocusPolicy(Qt::NoFocus);
  matrices_->setFocusPolicy(Qt::NoFocus);
  const DisplayedSource& displayed = windowState.displayed;
  const CurrentFrame& current = windowState.currentFrame;
  connect(&displayed, &DisplayedSource::shown, this, &ShowScene::takeHand);
  connect(&displayed, &DisplayedSource::handChanged, this, &ShowScene::takeHand);
  connect(&panel, &MatricesPanel::lookChanged, this, &ShowScene::takeLook);
  connect(&current, &CurrentFrame::frameChanged, this, &ShowScene::takeFrame);
  connect(&current, &CurrentFrame::resultsReceived, this, [this](const LiveResults& results) {
    if (const auto objects = windowState_.live.objects()) hand_->setObjects(*objects);
    hand_->setLiveMoment(*results.frame,
                         results.angles ? results.angles->values : std::vector<double>());
  });
  connect(&current, &CurrentFrame::staleNoticeChanged, this, [this, &current] {
    hand_->setStale(current.old());
    matrices_->setStale(current.old());
  });
  takeHand();
}

void ShowScene::takeHand() {
  const HandDescription* hand = windowState_.displayed.hand();
  setVisible(hand != nullptr);
  if (!hand) return;
  hand_->setHand(*hand);
  matrices_->setHand(*hand);
  takeLook();
  takeFrame();
}

void ShowScene::takeFrame() {
  const CurrentFrame& current = windowState_.currentFrame;
  if (!current.hasFrame()) return;
  matrices_->setFrame(current.frame());
  if (!windowState_.displayed.isLive())
    hand_->setMoment(current.frame(),
                     current.angles() ? current.angles()->values : std::vector<double>());
}

void ShowScene::takeLook() {
  const MatricesLook& colors = panel_.view().look();
  matrices_->setLook(colors);
  HandLook look = hand_->look();
  look.map = colors.map;
  look.range = colors.range;
  look.theme = colors.theme;
  hand_->setLook(look);
}

}  // namespace palpate::gui

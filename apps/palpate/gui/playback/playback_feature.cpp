#include "gui/playback/playback_feature.h"

#include <QComboBox>
#include <algorithm>
#include <iterator>

#include "gui/look/icons.h"
#include "gui/playback/playback_bar.h"

namespace palpate::gui {
namespace {

constexpr int kTenFrames = 10;

}  // namespace

PlaybackFeature::PlaybackFeature(Bench& bench, QWidget* window)
    : Feature(bench, window),
      actions_(bench.actions),
      bar_(new PlaybackBar(bench.playback, window)) {
  connectActions();
  connect(&bench.playback, &PlaybackController::stateChanged, this, &PlaybackFeature::showState);
  followTheme(bar_);
  connect(&bench.look, &ViewLook::themeChanged, this, &PlaybackFeature::showState);
}

void PlaybackFeature::connectActions() {
  PlaybackActions& actions = actions_;
  PlaybackController& playback = bench().playback;
  on(actions.play, [&playback] { playback.togglePlay(); });
  on(actions.stepBack, [&playback] { playback.step(-1); });
  on(actions.stepForward, [&playback] { playback.step(1); });
  on(actions.tenBack, [&playback] { playback.step(-kTenFrames); });
  on(actions.tenForward, [&playback] { playback.step(kTenFrames); });
  on(actions.toStart, [&playback] { playback.seekFrame(0); });
  on(actions.toEnd, [&playback] {
    playback.pause();
    playback.seekFrame(playback.numFrames());
  });
  on(actions.goToFrame, [this] { bar_->editFrame(); });
  on(actions.faster, [&playback] { playback.faster(); });
  on(actions.slower, [&playback] { playback.slower(); });
  on(actions.loop, [this, &playback](bool checked) {
    userLoops_ = checked;
    playback.setLoop(checked);
  });
  on(actions.skipGaps, [&playback](bool checked) { playback.setSkipGaps(checked); });
  const auto useSpeed = [&playback](int index) {
    playback.setSpeed(PlaybackController::kSpeeds[index]);
  };
  connect(bench().menus.speed, &QComboBox::activated, this, useSpeed);
  connect(actions.speeds, &QActionGroup::triggered, this, [useSpeed](const QAction* action) {
    useSpeed(action->data().toInt());
  });
  bench().enabling.add({actions.play,
                        actions.stepBack,
                        actions.stepForward,
                        actions.tenBack,
                        actions.tenForward,
                        actions.toStart,
                        actions.toEnd,
                        actions.goToFrame},
                       [this] { return bench().subject.hasFrames(); });
}

void PlaybackFeature::start() {
  const ViewSettings& view = bench().look.view();
  userLoops_ = view.loop;
  bench().playback.setSpeed(view.speed);
  bench().playback.setLoop(view.loop);
  bench().playback.setSkipGaps(view.skipGaps);
}

void PlaybackFeature::remember() {
  const PlaybackController& playback = bench().playback;
  bench().look.remember(playback.speed(), userLoops_, playback.skipGaps());
}

void PlaybackFeature::showState() {
  PlaybackActions& actions = actions_;
  const PlaybackController& playback = bench().playback;
  const Theme theme = bench().look.theme();
  const bool playing = playback.playing();
  actions.play->setIconText(playing ? " Pause" : " Play");
  actions.play->setIcon(makeIcon(playing ? IconShape::kPause : IconShape::kPlay, theme));
  actions.play->setToolTip(playing ? "Pause (Space)" : "Play by the real time stamps (Space)");
  actions.loop->setChecked(playback.loop());
  actions.skipGaps->setChecked(playback.skipGaps());
  const auto* at = std::find(std::begin(PlaybackController::kSpeeds),
                             std::end(PlaybackController::kSpeeds),
                             playback.speed());
  const bool known = at != std::end(PlaybackController::kSpeeds);
  const auto index = static_cast<int>(at - std::begin(PlaybackController::kSpeeds));
  if (known && index < actions.speeds->actions().size())
    actions.speeds->actions().at(index)->setChecked(true);
  bench().menus.speed->setCurrentIndex(known ? index : -1);
}

std::vector<CentreOffer> PlaybackFeature::centre() { return {{CentreOffer::Where::kBelow, bar_}}; }

}  // namespace palpate::gui

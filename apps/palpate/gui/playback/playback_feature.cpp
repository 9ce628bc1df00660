#include "gui/playback/playback_feature.h"

#include <QComboBox>
#include <algorithm>
#include <iterator>

#include "gui/appearance/icons.h"
#include "gui/playback/playback_bar.h"
#include "gui/source/playback_controller.h"

namespace palpate::gui {

PlaybackActions::PlaybackActions(ActionRegistry& book) {
  play = book.make("play", "Playback", "&Play or pause", {key("Space")});
  stepBack = book.make("stepBack", "Playback", "Step &back", {key("Left")});
  stepForward = book.make("stepForward", "Playback", "Step &forward", {key("Right")});
  tenBack = book.make("tenBack", "Playback", "Ten frames back", {key("Shift+Left")});
  tenForward = book.make("tenForward", "Playback", "Ten frames forward", {key("Shift+Right")});
  toStart = book.make("toStart", "Playback", "To the first frame", {key("Home")});
  toEnd = book.make("toEnd", "Playback", "To the last frame", {key("End")});
  goToFrame = book.make("goToFrame", "Playback", "&Go to frame…", {key("Ctrl+G")});
  faster = book.make("faster", "Playback", "F&aster", {key("Up"), key("+"), key("=")});
  slower = book.make("slower", "Playback", "&Slower", {key("Down"), key("-")});
  loop = book.make("loop", "Playback", "&Loop", {}, true);
  skipGaps = book.make("skipGaps", "Playback", "S&kip gaps", {}, true);
  skipGaps->setToolTip("Jump over the gaps of a recording while playing");
  QStringList names;
  for (const double speed : PlaybackController::kSpeeds) names.append(QString::number(speed) + "×");
  speeds = book.choices("speeds", names);
  loop->setIconText(" " + plainText(*loop));
  skipGaps->setIconText(" " + plainText(*skipGaps));
  toStart->setIcon(makeIcon(IconShape::kToStart));
  stepBack->setIcon(makeIcon(IconShape::kStepBack));
  stepForward->setIcon(makeIcon(IconShape::kStepForward));
  loop->setIcon(makeIcon(IconShape::kLoop));
  skipGaps->setIcon(makeIcon(IconShape::kSkipGaps));
}

namespace {

constexpr int kTenFrames = 10;

}  // namespace

PlaybackFeature::PlaybackFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      actions_(windowState.actions),
      bar_(new PlaybackBar(windowState.playback, window)) {
  connectActions();
  connect(
      &windowState.playback, &PlaybackController::stateChanged, this, &PlaybackFeature::showState);
}

void PlaybackFeature::connectActions() {
  PlaybackActions& actions = actions_;
  PlaybackController& playback = state().playback;
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
  connect(state().menus.speed, &QComboBox::activated, this, useSpeed);
  connect(actions.speeds, &QActionGroup::triggered, this, [useSpeed](const QAction* action) {
    useSpeed(action->data().toInt());
  });
  state().actionEnabler.add({actions.play,
                             actions.stepBack,
                             actions.stepForward,
                             actions.tenBack,
                             actions.tenForward,
                             actions.toStart,
                             actions.toEnd,
                             actions.goToFrame,
                             actions.faster,
                             actions.slower,
                             actions.loop,
                             actions.skipGaps},
                            [this] { return state().displayed.hasFrames(); });
}

void PlaybackFeature::start() {
  const ViewSettings& view = state().appearance.view();
  userLoops_ = view.loop;
  state().playback.setSpeed(view.speed);
  state().playback.setLoop(view.loop);
  state().playback.setSkipGaps(view.skipGaps);
}

void PlaybackFeature::remember() {
  const PlaybackController& playback = state().playback;
  state().appearance.remember(playback.speed(), userLoops_, playback.skipGaps());
}

void PlaybackFeature::showState() {
  PlaybackActions& actions = actions_;
  const PlaybackController& playback = state().playback;
  const bool playing = playback.playing();
  actions.play->setIconText(playing ? " Pause" : " Play");
  actions.play->setIcon(makeIcon(playing ? IconShape::kPause : IconShape::kPlay));
  actions.play->setToolTip(playing ? "Pause (Space)" : "Play at the recorded times (Space)");
  actions.loop->setChecked(playback.loop());
  actions.skipGaps->setChecked(playback.skipGaps());
  const auto* at = std::find(std::begin(PlaybackController::kSpeeds),
                             std::end(PlaybackController::kSpeeds),
                             playback.speed());
  const bool known = at != std::end(PlaybackController::kSpeeds);
  const auto index = static_cast<int>(at - std::begin(PlaybackController::kSpeeds));
  if (known && index < actions.speeds->actions().size())
    actions.speeds->actions().at(index)->setChecked(true);
  state().menus.speed->setCurrentIndex(known ? index : -1);
}

std::vector<CentralViewSpec> PlaybackFeature::centre() {
  return {{CentralViewSpec::Where::kBelow, bar_}};
}

}  // namespace palpate::gui

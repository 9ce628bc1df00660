#include "gui/playback/playback_actions.h"

#include "gui/appearance/icons.h"
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
  loop = book.make("loop", "Playback", "&Loop", {key("L")}, true);
  skipGaps = book.make("skipGaps", "Playback", "Skip &gaps", {key("G")}, true);
  skipGaps->setToolTip("Jump over the gaps of a recording while playing (G)");
  QStringList names;
  for (const double speed : PlaybackController::kSpeeds) names.append(QString::number(speed) + "×");
  speeds = book.choices("speeds", names);
  loop->setIconText(" " + plainText(*loop));
  skipGaps->setIconText(" " + plainText(*skipGaps));
  book.setIcon(toStart, IconShape::kToStart);
  book.setIcon(stepBack, IconShape::kStepBack);
  book.setIcon(stepForward, IconShape::kStepForward);
  book.setIcon(loop, IconShape::kLoop);
  book.setIcon(skipGaps, IconShape::kSkipGaps);
}

}  // namespace palpate::gui

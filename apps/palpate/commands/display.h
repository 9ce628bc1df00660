// Whether a window can be shown at all: asked before Qt is, because Qt aborts where it can't.
#pragma once

namespace palpate::commands {

// True when an X server or a Wayland compositor answers, or QT_QPA_PLATFORM names another platform.
bool hasDisplay();
// Makes Qt draw without a display (platform "offscreen") unless a platform was chosen already.
// `evenWithDisplay`: also where a display exists (pictures need none).
void drawWithoutDisplay(bool evenWithDisplay);

}  // namespace palpate::commands

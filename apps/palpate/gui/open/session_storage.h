// Stores between two runs of the program which recordings are open, and the position and view in
// each.
#pragma once

#include "gui/window_state/window_state.h"

namespace palpate::gui {

// Opens what was open when the window was last closed, with the same positions and views.
void restoreSession(WindowState& windowState);
// Stores what is open now.
void rememberSession(WindowState& windowState);

}  // namespace palpate::gui

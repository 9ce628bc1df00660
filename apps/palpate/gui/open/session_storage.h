// Which recordings are open, and where the user is in each, from one day to the next.
#pragma once

#include "gui/window_state/window_state.h"

namespace palpate::gui {

// What was open when the window was closed last, as it was.
void restoreSession(WindowState& windowState);
void rememberSession(WindowState& windowState);

}  // namespace palpate::gui

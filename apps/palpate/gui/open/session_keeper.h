// Which recordings are open, and where the user is in each, from one day to the next.
#pragma once

#include "gui/bench/bench.h"

namespace palpate::gui {

// What was open when the window was closed last, as it was.
void restoreSession(Bench& bench);
void rememberSession(Bench& bench);

}  // namespace palpate::gui

// Properties that a dialogue sets to tell the rest of the window what it wants.
#pragma once

namespace palpate::gui {

// True: a dialogue that isn't modal gets a button Stop while a hand is connected that can be moved,
// as each modal dialogue does; set it before the dialogue is shown.
inline constexpr const char* kWantsStopProperty = "wantsStop";

}  // namespace palpate::gui

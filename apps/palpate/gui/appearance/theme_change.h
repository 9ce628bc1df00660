// Tells widgets that the theme is another one.
#pragma once

#include <QEvent>

namespace palpate::gui {

// Sent to every widget by applyTheme(): Qt itself tells widgets of a new palette only while the
// application runs.
QEvent::Type themeChange();

}  // namespace palpate::gui

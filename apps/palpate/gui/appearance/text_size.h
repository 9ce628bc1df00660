// The size of the window's text, which the user can choose; remembered in the settings.
#pragma once

#include <QSettings>

namespace palpate::gui {

// Sizes that can be chosen [pt]; 0: that of the desktop.
inline constexpr int kMinInterfaceTextPt = 7;
inline constexpr int kMaxInterfaceTextPt = 18;

// 0 where nothing, or nothing sensible, was chosen.
int loadTextPt(const QSettings& settings);
void saveTextPt(int pt, QSettings& settings);
// Gives all widgets, present and future, text of this size. Texts that are larger or smaller than
// the others stay so in proportion.
void applyTextPt(int pt);
// The present size of text over that of the desktop, as set by applyTextPt(); 1 before.
double textScale() noexcept;

}  // namespace palpate::gui

// Sizes of controls that follow from their text, and style sheets that follow from the theme: they
// are computed anew when the size of the text (dialog Settings) or the theme changes.
#pragma once

#include <functional>

class QAbstractButton;
class QWidget;

namespace palpate::gui {

// Calls `fit` at once, and again after each change of the font of `widget`, once all widgets have
// their new font. `fit` may use what lives as long as `widget`.
void fitToText(QWidget& widget, std::function<void()> fit);
// The same after each change of the theme, for style sheets: whatever paints itself asks for its
// colours when it paints.
void fitToTheme(QWidget& widget, std::function<void()> fit);
// Makes the button at least `leastPx` wide [px], or as wide as its text needs.
void keepWide(QAbstractButton& button, int leastPx);

}  // namespace palpate::gui

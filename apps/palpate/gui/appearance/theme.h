// The dark and the light theme: colours of the window, of exported pictures, and of the matrices in
// charts.
#pragma once

#include <QColor>
#include <QString>
#include <array>
#include <cstddef>

#include <palpate/core/option_check.h>

class QApplication;

namespace palpate::gui {

enum class Theme { kDark, kLight };
inline constexpr std::array<OptionWord<Theme>, 2> kThemeWords{
    {{"dark", Theme::kDark}, {"light", Theme::kLight}}};
// The theme that the user chose; kSystem follows the desktop.
enum class ThemeChoice { kSystem, kDark, kLight };
inline constexpr std::array kAllThemeChoices = {
    ThemeChoice::kSystem, ThemeChoice::kDark, ThemeChoice::kLight};

struct ThemeColors {
  // Background of the window.
  QColor window;
  // Background of bars and docks.
  QColor panel;
  // Background of buttons and fields.
  QColor raised;
  // Hairlines.
  QColor border;
  // Contrast of at least 7:1 on `window` and `panel`.
  QColor text;
  // Captions; contrast of at least 4.5:1.
  QColor muted;
  // Whatever is switched on, and the cursor.
  QColor accent;
  // Background of whatever is switched on.
  QColor accentSoft;
  // Failures.
  QColor danger;
  // Background of the message of a failure.
  QColor dangerSoft;
  // Whatever needs attention: gaps, saturated taxels.
  QColor warning;
  // A taxel without contact.
  QColor taxel;
  // Hatching of a taxel that isn't scanned.
  QColor maskedLine;
  // Grid of charts.
  QColor grid;
  // Shade over a gap of a recording.
  QColor gap;
};

// The theme that the program shows, read from its palette: colours are asked for when something is
// painted, and need not be stored.
Theme shownTheme();
const ThemeColors& colorsOf(Theme theme = shownTheme());
// One colour per matrix, the same in all views; colour-blind people can tell them apart (after
// Okabe and Ito). Repeats after six.
QColor matrixColor(std::size_t matrix, Theme theme = shownTheme());
// Colour of the hand as a whole.
QColor wholeColor(Theme theme = shownTheme());
// Mixes two colours; `part`: share of `to`, 0..1.
QColor mixed(const QColor& from, const QColor& to, double part);

// The theme of the desktop when the program started.
Theme systemTheme();
Theme resolved(ThemeChoice choice);
// "system", "dark", "light"; themeChoiceFrom() returns kSystem for any other text.
QString nameOf(ThemeChoice choice);
ThemeChoice themeChoiceFrom(const QString& name);
// Applies a theme to the whole program.
void applyTheme(QApplication& application, Theme theme);

}  // namespace palpate::gui

// Dark and light: the colours of the window, of the pictures, and of the matrices in charts.
#pragma once

#include <QColor>
#include <QString>
#include <array>
#include <cstddef>

class QApplication;

namespace palpate::gui {

enum class Theme { kDark, kLight };
// What the user asked for; kSystem follows the desktop.
enum class ThemeChoice { kSystem, kDark, kLight };
inline constexpr std::array kAllThemeChoices = {
    ThemeChoice::kSystem, ThemeChoice::kDark, ThemeChoice::kLight};

struct ThemeColors {
  QColor window;      // behind everything
  QColor panel;       // bars, docks
  QColor raised;      // buttons, fields
  QColor border;      // hairlines
  QColor text;        // 7:1 and more on window and panel
  QColor muted;       // captions; 4.5:1 and more
  QColor accent;      // what is on, the cursor
  QColor accentSoft;  // background of what is on
  QColor danger;      // failures
  QColor dangerSoft;  // background of a failure's message
  QColor warning;     // what needs a look: gaps, saturated taxels
  QColor taxel;       // a taxel that feels nothing
  QColor maskedLine;  // hatching of a taxel that isn't scanned
  QColor grid;        // of charts
  QColor gap;         // shade over a gap of a recording
};

const ThemeColors& colorsOf(Theme theme);
// One colour per matrix, the same wherever it is named; told apart by colour-blind eyes (after
// Okabe and Ito). Repeats after six.
QColor matrixColor(std::size_t matrix, Theme theme);
// The hand as a whole.
QColor wholeColor(Theme theme);
// `part` of the way from one to the other, 0..1.
QColor mixed(const QColor& from, const QColor& to, double part);

// The desktop's own theme, as it was when the program started.
Theme systemTheme();
Theme resolved(ThemeChoice choice);
// "system", "dark", "light"; anything else reads as kSystem.
QString nameOf(ThemeChoice choice);
ThemeChoice themeChoiceFrom(const QString& name);
// Gives the whole program a theme.
void applyTheme(QApplication& application, Theme theme);

}  // namespace palpate::gui

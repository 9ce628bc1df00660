#include "gui/appearance/theme.h"

#include <QApplication>
#include <QPalette>
#include <QPointer>
#include <QWidget>
#include <array>
#include <utility>
#include <vector>

#include "gui/appearance/theme_change.h"

namespace palpate::gui {
namespace {

QPalette paletteOf(Theme theme) {
  const ThemeColors& colors = colorsOf(theme);
  QPalette palette;
  palette.setColor(QPalette::Window, colors.panel);
  palette.setColor(QPalette::WindowText, colors.text);
  palette.setColor(QPalette::Base, colors.window);
  palette.setColor(QPalette::AlternateBase, colors.panel);
  palette.setColor(QPalette::Text, colors.text);
  palette.setColor(QPalette::PlaceholderText, colors.muted);
  palette.setColor(QPalette::Button, colors.raised);
  palette.setColor(QPalette::ButtonText, colors.text);
  palette.setColor(QPalette::BrightText, colors.danger);
  palette.setColor(QPalette::ToolTipBase, colors.raised);
  palette.setColor(QPalette::ToolTipText, colors.text);
  palette.setColor(QPalette::Link, colors.accent);
  palette.setColor(QPalette::Highlight, colors.accent);
  palette.setColor(QPalette::HighlightedText, theme == Theme::kDark ? colors.window : Qt::white);
  palette.setColor(QPalette::Mid, colors.border);
  palette.setColor(QPalette::Dark, colors.border);
  for (const auto role :
       {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::PlaceholderText}) {
    QColor faded = colors.muted;
    faded.setAlphaF(0.55F);
    palette.setColor(QPalette::Disabled, role, faded);
  }
  return palette;
}

// Style sheet of the program; @name is replaced by a colour of the theme.
constexpr const char* kThemeStyle = R"(
QMainWindow::separator { background: @border; width: 1px; height: 1px; }
QMainWindow::separator:hover { background: @accent; }
QMenuBar { background: @panel; border-bottom: 1px solid @border; padding: 1px 6px; }
QMenuBar::item { padding: 4px 9px; border-radius: 4px; background: transparent; }
QMenuBar::item:selected { background: @raised; }
QMenu { background: @raised; border: 1px solid @border; padding: 4px; }
QMenu::item { padding: 5px 26px 5px 24px; border-radius: 4px; }
QMenu::item:selected { background: @accentSoft; color: @text; }
QMenu::item:disabled { color: @muted; }
QMenu::separator { height: 1px; background: @border; margin: 4px 6px; }
QToolBar { background: @panel; border: 0; border-bottom: 1px solid @border; padding: 5px 8px; spacing: 5px; }
QToolBar::separator { background: @border; width: 1px; margin: 4px 5px; }
QToolButton { background: @raised; border: 1px solid @border; border-radius: 5px; padding: 4px 8px; }
QToolButton:hover { border-color: @accent; }
QToolButton:pressed { background: @accentSoft; }
QToolButton:checked { background: @accentSoft; border-color: @accent; color: @accent; }
QToolButton:disabled { background: transparent; }
QToolButton[flat="true"] { background: transparent; border-color: transparent; }
QToolButton[flat="true"]:hover { border-color: @accent; }
QFileDialog QToolButton { padding: 2px; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QInputDialog { min-width: 380px; }
QPushButton { background: @raised; border: 1px solid @border; border-radius: 5px; padding: 5px 14px; }
QPushButton:hover { border-color: @accent; }
QPushButton:focus { border-color: @text; }
QPushButton:pressed { background: @accentSoft; }
QPushButton[primary="true"] { background: @accentSoft; border-color: @accent; color: @accent; }
QPushButton[primary="true"]:disabled { background: transparent; border-color: @border; color: @muted; }
QPushButton[danger="true"] { background: @dangerSoft; border-color: @danger; color: @danger; font-weight: bold; }
QPushButton[danger="true"]:pressed { background: @danger; color: @window; }
QPushButton[danger="true"]:disabled { background: transparent; border-color: @border; color: @muted; }
#stopHand:enabled { background: #b3261e; border-color: #b3261e; color: #ffffff; }
#stopHand:enabled:pressed { background: #7f1712; }
QAbstractSpinBox, QComboBox, QLineEdit { background: @window; border: 1px solid @border; border-radius: 4px; padding: 3px 5px; }
QAbstractSpinBox:focus, QComboBox:focus, QLineEdit:focus, QComboBox:hover { border-color: @text; }
QAbstractSpinBox QLineEdit, QComboBox QLineEdit, QAbstractItemView QLineEdit { border: 0; padding: 0; }
QToolBar QComboBox { padding: 4px 5px; }
QComboBox::drop-down { border: 0; width: 18px; }
QComboBox QAbstractItemView { background: @raised; color: @text; border: 1px solid @border; selection-background-color: @accentSoft; selection-color: @text; }
QComboBox::down-arrow { image: url(:/arrows/down.png); }
QComboBox:disabled, QLineEdit:disabled { color: @muted; background: @panel; }
QAbstractSpinBox::up-button, QAbstractSpinBox::down-button { width: 16px; border: 0; background: transparent; }
QAbstractSpinBox::up-button { subcontrol-position: top right; }
QAbstractSpinBox::down-button { subcontrol-position: bottom right; }
QAbstractSpinBox::up-arrow { image: url(:/arrows/up.png); }
QAbstractSpinBox::down-arrow { image: url(:/arrows/down.png); }
QAbstractSpinBox::up-arrow:off, QAbstractSpinBox::down-arrow:off { image: none; }
#FocusFrame { border: 1px solid @text; border-radius: 3px; background: transparent; }
QAbstractSpinBox[refused="true"] { border-color: @warning; color: @warning; font-weight: bold; }
QAbstractSpinBox:disabled { color: @muted; }
QListWidget:disabled { color: @muted; }
QDockWidget { titlebar-close-icon: none; titlebar-normal-icon: none; }
QStatusBar { background: @panel; border-top: 1px solid @border; }
QStatusBar::item { border: 0; }
QTableView { background: @panel; border: 0; gridline-color: @border; }
QHeaderView { background: @panel; }
QHeaderView::section { background: @panel; color: @muted; border: 0; border-bottom: 1px solid @border; padding: 3px 6px; }
QTableCornerButton::section { background: @panel; border: 0; }
QScrollArea { border: 0; background: @panel; }
QScrollBar:vertical { background: transparent; width: 10px; }
QScrollBar::handle:vertical { background: @border; border-radius: 4px; min-height: 24px; margin: 1px; }
QScrollBar::add-line, QScrollBar::sub-line { height: 0; width: 0; }
QToolTip { background: @raised; color: @text; border: 1px solid @border; padding: 4px; }
QProgressBar { background: @window; border: 1px solid @border; border-radius: 4px; text-align: center; }
QProgressBar::chunk { background: @accent; border-radius: 3px; }
QLabel[role="heading"] { color: @muted; font-weight: bold; }
QLabel[role="muted"] { color: @muted; }
QLabel[role="warning"] { color: @warning; }
QLabel[role="problem"] { color: @danger; }
QFrame[role="foot"] { border-top: 1px solid @border; }
#MessageBanner { background: @dangerSoft; border-bottom: 1px solid @danger; }
#AlarmStrip { background: @dangerSoft; border-bottom: 1px solid @danger; }
#CountdownStrip { background: @dangerSoft; border-bottom: 1px solid @danger; }
#OfferStrip { background: @accentSoft; border-bottom: 1px solid @accent; }
#OfferStrip[warning="true"] { background: @panel; border-bottom: 1px solid @warning; }
#OfferStrip[warning="true"] QLabel { color: @warning; }
#LinkPill { background: @dangerSoft; border: 1px solid @warning; border-radius: 10px; padding: 2px 10px; margin: 0 4px; color: @warning; }
#LinkPill[good="true"] { background: @accentSoft; border-color: @accentSoft; color: @accent; }
QToolButton[recording="true"] { background: @dangerSoft; border: 1px solid @danger; color: @danger; font-weight: bold; }
#linkLog { background: @window; border: 1px solid @border; border-radius: 4px; color: @muted; }
#libraryTable::item, #logTable::item { padding: 0 6px; border: 0; }
#libraryTable::item:selected, #logTable::item:selected { background: @accentSoft; color: @text; }
#filterList { border: 1px solid @border; border-radius: 4px; }
#filterList::item { padding: 4px 2px; border: 0; }
#filterList::item:selected { background: @accentSoft; color: @text; }
#filterList::indicator { width: 11px; height: 11px; border: 1px solid @muted; border-radius: 3px; background: @window; }
#filterList::indicator:checked { border-color: @accent; background: @accent; }
#OpeningStrip { background: @panel; border-bottom: 1px solid @border; }
#ViewHeader, #PlaybackBar { background: @panel; }
#PlaybackBar { border-top: 1px solid @border; }
#ViewHeader { border-bottom: 1px solid @border; }
#DockTitle { background: @panel; border-bottom: 1px solid @border; }
#StartPage, #DropHint { background: @window; }
#DropHint { border: 1px dashed @border; border-radius: 8px; color: @muted; }
#DropHint[dragging="true"] { border-color: @accent; color: @accent; background: @accentSoft; }
#RecentRow { background: @panel; border: 1px solid @border; border-radius: 6px; text-align: left; padding: 0; }
#RecentRow:hover { border-color: @accent; }
#RecentRow:focus { border-color: @text; }
)";

QString styleOf(Theme theme) {
  const ThemeColors& colors = colorsOf(theme);
  QString style = kThemeStyle;
  // Longer names are replaced first: @accentSoft begins with @accent.
  const std::pair<const char*, QColor> names[] = {{"@accentSoft", colors.accentSoft},
                                                  {"@dangerSoft", colors.dangerSoft},
                                                  {"@accent", colors.accent},
                                                  {"@warning", colors.warning},
                                                  {"@danger", colors.danger},
                                                  {"@window", colors.window},
                                                  {"@panel", colors.panel},
                                                  {"@raised", colors.raised},
                                                  {"@border", colors.border},
                                                  {"@text", colors.text},
                                                  {"@muted", colors.muted}};
  for (const auto& [name, color] : names) style.replace(name, color.name());
  return style;
}

// The style Fusion derives outlines from the background by darkening it; on a dark background such
// outlines would be invisible.
void outlineFields(Theme theme) {
  QPalette palette = paletteOf(theme);
  if (theme == Theme::kDark) palette.setColor(QPalette::Window, colorsOf(theme).muted);
  for (const char* field : {"QCheckBox", "QRadioButton", "QAbstractItemView"})
    QApplication::setPalette(palette, field);
}

}  // namespace

const ThemeColors& colorsOf(Theme theme) {
  static const ThemeColors dark = {.window = "#131518",
                                   .panel = "#1a1d22",
                                   .raised = "#23272e",
                                   .border = "#343a44",
                                   .text = "#e8eaee",
                                   .muted = "#9aa3b2",
                                   .accent = "#5eead4",
                                   .accentSoft = "#173b39",
                                   .danger = "#ff7b72",
                                   .dangerSoft = "#3d1c1e",
                                   .warning = "#f5b94a",
                                   .taxel = "#2a2e36",
                                   .maskedLine = "#454c58",
                                   .grid = "#2a2f37",
                                   .gap = QColor(245, 185, 74, 28)};
  static const ThemeColors light = {.window = "#ffffff",
                                    .panel = "#f6f7f9",
                                    .raised = "#ffffff",
                                    .border = "#d3d8e0",
                                    .text = "#16191f",
                                    .muted = "#5b6472",
                                    .accent = "#0b7a6f",
                                    .accentSoft = "#d8f1ed",
                                    .danger = "#b3261e",
                                    .dangerSoft = "#fdeceb",
                                    .warning = "#8f5b00",
                                    .taxel = "#e3e6eb",
                                    .maskedLine = "#bcc3ce",
                                    .grid = "#e4e7ec",
                                    .gap = QColor(176, 120, 0, 30)};
  return theme == Theme::kDark ? dark : light;
}

QColor matrixColor(std::size_t matrix, Theme theme) {
  static const std::array<QColor, 6> dark = {
      "#2fbf94", "#f2a900", "#d98bb8", "#e8663c", "#f0e442", "#5eb8f0"};
  static const std::array<QColor, 6> light = {
      "#00795a", "#c17d00", "#a8457e", "#c24a00", "#5b4bb7", "#0b84c6"};
  return theme == Theme::kDark ? dark[matrix % dark.size()] : light[matrix % light.size()];
}

QColor mixed(const QColor& from, const QColor& to, double part) {
  const auto mix = [share = static_cast<float>(part)](float a, float b) {
    return a + (b - a) * share;
  };
  return QColor::fromRgbF(
      mix(from.redF(), to.redF()), mix(from.greenF(), to.greenF()), mix(from.blueF(), to.blueF()));
}

QColor wholeColor(Theme theme) { return theme == Theme::kDark ? "#c3c9d3" : "#3d4654"; }

Theme shownTheme() {
  constexpr int kHalf = 128;
  return QGuiApplication::palette().color(QPalette::Window).lightness() < kHalf ? Theme::kDark
                                                                                : Theme::kLight;
}

Theme systemTheme() {
  constexpr int kHalf = 128;
  static const Theme theme = QApplication::palette().color(QPalette::Window).lightness() < kHalf
                                 ? Theme::kDark
                                 : Theme::kLight;
  return theme;
}

Theme resolved(ThemeChoice choice) {
  if (choice == ThemeChoice::kSystem) return systemTheme();
  return choice == ThemeChoice::kDark ? Theme::kDark : Theme::kLight;
}

QString nameOf(ThemeChoice choice) {
  switch (choice) {
    case ThemeChoice::kDark:
      return "dark";
    case ThemeChoice::kLight:
      return "light";
    case ThemeChoice::kSystem:
      break;
  }
  return "system";
}

ThemeChoice themeChoiceFrom(const QString& name) {
  if (name == "dark") return ThemeChoice::kDark;
  if (name == "light") return ThemeChoice::kLight;
  return ThemeChoice::kSystem;
}

QEvent::Type themeChange() {
  static const int type = QEvent::registerEventType();
  return static_cast<QEvent::Type>(type);
}

void applyTheme(QApplication& application, Theme theme) {
  // Reads the theme of the desktop before the palette is replaced.
  systemTheme();
  // Setting the same style again would restyle every widget several times.
  if (application.styleSheet() == styleOf(theme)) return;
  // A widget that the style sheet gives a font (bold) gets the size back that it had before the
  // first style sheet, whatever size of text was chosen since.
  std::vector<std::pair<QPointer<QWidget>, double>> sizesPt;
  for (QWidget* widget : QApplication::allWidgets())
    sizesPt.emplace_back(widget, widget->font().pointSizeF());
  QApplication::setPalette(paletteOf(theme));
  outlineFields(theme);
  application.setStyleSheet(styleOf(theme));
  for (const auto& [widget, pt] : sizesPt) {
    if (!widget || !(pt > 0.0) || widget->font().pointSizeF() == pt) continue;
    QFont font = widget->font();
    font.setPointSizeF(pt);
    widget->setFont(font);
  }
  QEvent change(themeChange());
  for (const auto& [widget, pt] : sizesPt) {
    if (!widget) continue;
    QCoreApplication::sendEvent(widget, &change);
    if (widget) widget->update();
  }
}

}  // namespace palpate::gui

// The size that the window may have on a screen.
#pragma once

#include <QGuiApplication>
#include <QScreen>
#include <QSize>

namespace palpate::gui {

// The largest size [px] at which the window lies within the screen, with its frame and title bar
// (estimated, since the window manager tells them only later). Null: the primary screen. Empty: no
// screen is there.
inline QSize roomOnScreen(const QScreen* screen) {
  constexpr QSize kFrame(4, 36);
  if (!screen) screen = QGuiApplication::primaryScreen();
  return screen ? screen->availableSize() - kFrame : QSize();
}

}  // namespace palpate::gui

// Gives a window the keyboard, as a window manager would.
#pragma once

#include <QCoreApplication>
#include <QWidget>

namespace palpate::gui {

// `window` is shown. Where it already has the keyboard no event is processed.
inline void makeActive(QWidget& window) {
  if (window.isActiveWindow()) return;
  window.activateWindow();
  QCoreApplication::processEvents();
}

}  // namespace palpate::gui

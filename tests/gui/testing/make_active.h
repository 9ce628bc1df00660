#pragma once

#include <QCoreApplication>
#include <QWidget>

namespace palpate::gui {

// Gives a shown window the focus: without a window manager nobody else does.
inline void makeActive(QWidget& window) {
  window.activateWindow();
  QCoreApplication::processEvents();
}

}  // namespace palpate::gui

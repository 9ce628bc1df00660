#include "gui/desktop/popup_escape.h"

#include <QApplication>
#include <QKeyEvent>
#include <QTimer>

namespace palpate::gui {

PopupEscape::PopupEscape(QObject* parent) : QObject(parent) { qApp->installEventFilter(this); }

bool PopupEscape::eventFilter(QObject* /*watched*/, QEvent* event) {
  if (event->type() != QEvent::ShortcutOverride || inPopup_) return false;
  if (static_cast<QKeyEvent*>(event)->key() != Qt::Key_Escape) return false;
  inPopup_ = QApplication::activePopupWidget() != nullptr;
  // The shortcut follows before the next event.
  if (inPopup_) QTimer::singleShot(0, this, [this] { inPopup_ = false; });
  return false;
}

}  // namespace palpate::gui

#include "gui/desktop/button_keys.h"

#include <QAbstractButton>
#include <QApplication>
#include <QDialog>
#include <QKeyEvent>
#include <QPushButton>
#include <QToolButton>

namespace palpate::gui {

ButtonKeys::ButtonKeys(QObject* parent) : QObject(parent) { qApp->installEventFilter(this); }

bool ButtonKeys::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::KeyPress && event->type() != QEvent::KeyRelease) return false;
  auto* button = qobject_cast<QAbstractButton*>(watched);
  if (!button) return false;
  const auto* key = static_cast<const QKeyEvent*>(event);
  if (key->key() == Qt::Key_Space) return button->property(kMovesHand).toBool();
  const bool presses = key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter;
  const bool plain = (key->modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
  if (!presses || !plain) return false;
  // In a dialogue a check box leaves these keys to the default button. A button that isn't meant
  // for the default, such as Cancel, would do so, too, but the user sees the focus on it.
  if (qobject_cast<QDialog*>(button->window()) && !qobject_cast<QPushButton*>(button)) return false;
  // A key that is held down presses the button only once.
  if (event->type() == QEvent::KeyPress && !key->isAutoRepeat() && button->isEnabled()) {
    auto* tool = qobject_cast<QToolButton*>(button);
    if (tool && tool->menu() && tool->popupMode() == QToolButton::InstantPopup)
      tool->showMenu();
    else
      button->click();
  }
  return true;
}

}  // namespace palpate::gui

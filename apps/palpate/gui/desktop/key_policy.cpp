#include "gui/desktop/key_policy.h"

#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QTimer>
#include <QToolButton>
#include <algorithm>

namespace palpate::gui {
namespace {

// Whether the key of the window is kept from the field that has the focus.
bool passField(QObject& watched, QEvent& event) {
  if (event.type() == QEvent::MouseButtonDblClick) {
    auto* number = qobject_cast<QAbstractSpinBox*>(watched.parent());
    if (!number || !qobject_cast<QLineEdit*>(&watched)) return false;
    number->selectAll();
    return true;
  }
  if (event.type() != QEvent::ShortcutOverride) return false;
  // A list that can be typed into has the focus in place of its field.
  const auto* list = qobject_cast<QComboBox*>(&watched);
  if (!qobject_cast<QLineEdit*>(&watched) && !qobject_cast<QAbstractSpinBox*>(&watched) &&
      !(list && list->isEditable()))
    return false;
  const auto& key = static_cast<const QKeyEvent&>(event);
  const bool letter = key.key() >= Qt::Key_A && key.key() <= Qt::Key_Z;
  if (!letter || key.modifiers() != Qt::ControlModifier) return false;
  for (const Qt::Key own : {Qt::Key_A, Qt::Key_C, Qt::Key_V, Qt::Key_X, Qt::Key_Y, Qt::Key_Z})
    if (key.key() == own) return false;
  // An ignored override lets the shortcut be looked up; without one, the field gets the key.
  event.ignore();
  return true;
}

bool pressFocusedButton(QObject& watched, const QEvent& event) {
  if (event.type() != QEvent::KeyPress && event.type() != QEvent::KeyRelease) return false;
  auto* button = qobject_cast<QAbstractButton*>(&watched);
  if (!button) return false;
  const auto& key = static_cast<const QKeyEvent&>(event);
  if (key.key() == Qt::Key_Space) return button->property(kMovesHand).toBool();
  const bool presses = key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter;
  const bool plain = (key.modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
  if (!presses || !plain) return false;
  // In a dialogue a check box leaves these keys to the default button. A button that isn't meant
  // for the default, such as Cancel, would do so, too, but the user sees the focus on it.
  if (qobject_cast<QDialog*>(button->window()) && !qobject_cast<QPushButton*>(button)) return false;
  // A key that is held down presses the button only once.
  if (event.type() == QEvent::KeyPress && !key.isAutoRepeat() && button->isEnabled()) {
    auto* tool = qobject_cast<QToolButton*>(button);
    if (tool && tool->menu() && tool->popupMode() == QToolButton::InstantPopup)
      tool->showMenu();
    else
      button->click();
  }
  return true;
}

bool isGuarded(const QWidget& widget) {
  if (qobject_cast<const QAbstractSpinBox*>(&widget) || qobject_cast<const QComboBox*>(&widget))
    return true;
  return qobject_cast<const QAbstractSlider*>(&widget) &&
         !qobject_cast<const QScrollBar*>(&widget) && !widget.property(kTakesWheel).toBool();
}

bool guardFromWheel(QObject& watched, QEvent& event) {
  if (event.type() != QEvent::Wheel && event.type() != QEvent::Polish) return false;
  auto* widget = qobject_cast<QWidget*>(&watched);
  if (!widget || !isGuarded(*widget)) return false;
  if (event.type() == QEvent::Polish) {
    // With Qt::WheelFocus the wheel would give the control the focus first.
    if (widget->focusPolicy() == Qt::WheelFocus) widget->setFocusPolicy(Qt::StrongFocus);
    return false;
  }
  if (widget->hasFocus()) return false;
  // An ignored event goes to the parent, which scrolls.
  event.ignore();
  return true;
}

}  // namespace

KeyPolicy::KeyPolicy(QObject* parent) : QObject(parent) { qApp->installEventFilter(this); }

KeyPolicy& KeyPolicy::ofApplication() {
  static QPointer<KeyPolicy> policy;
  if (!policy) policy = new KeyPolicy(qApp);
  return *policy;
}

void KeyPolicy::install(Order order, QObject& filter) {
  filters_.removeIf([](const auto& each) { return !each.second; });
  const auto at = std::find_if(
      filters_.begin(), filters_.end(), [order](const auto& each) { return each.first > order; });
  filters_.emplace(at, order, &filter);
  // Qt asks the filter of the application first that was installed last.
  qApp->installEventFilter(this);
}

bool KeyPolicy::eventFilter(QObject* watched, QEvent* event) {
  // A copy: a filter may open a dialogue or end another one.
  const auto filters = filters_;
  for (const auto& [order, filter] : filters)
    if (filter && filter->eventFilter(watched, event)) return true;
  followEscape(*event);
  return passField(*watched, *event) || pressFocusedButton(*watched, *event) ||
         guardFromWheel(*watched, *event);
}

void KeyPolicy::followEscape(const QEvent& event) {
  if (event.type() != QEvent::ShortcutOverride || escapeInPopup_) return;
  if (static_cast<const QKeyEvent&>(event).key() != Qt::Key_Escape) return;
  escapeInPopup_ = QApplication::activePopupWidget() != nullptr;
  // The shortcut follows before the next event.
  if (escapeInPopup_) QTimer::singleShot(0, this, [this] { escapeInPopup_ = false; });
}

}  // namespace palpate::gui

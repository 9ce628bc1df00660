#include "gui/desktop/greyed_keys.h"

#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDialog>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMenu>
#include <QPlainTextEdit>
#include <QToolTip>
#include <QWidget>
#include <utility>

#include "gui/desktop/key_policy.h"

namespace palpate::gui {
namespace {

// A dialogue keeps its keys to itself.
bool isWindowOrPartOf(const QWidget& widget, const QWidget* window) {
  const QWidget* top = widget.window();
  while (top != window && top->parentWidget() && !qobject_cast<const QDialog*>(top))
    top = top->parentWidget()->window();
  return top == window;
}

// Undo, copy and the like belong to the field that is typed into.
bool belongsToField(const QWidget& widget, const QKeyEvent& key) {
  const auto* list = qobject_cast<const QComboBox*>(&widget);
  if (!qobject_cast<const QLineEdit*>(&widget) && !qobject_cast<const QAbstractSpinBox*>(&widget) &&
      !qobject_cast<const QPlainTextEdit*>(&widget) && !(list && list->isEditable()))
    return false;
  for (const auto own : {QKeySequence::Undo,
                         QKeySequence::Redo,
                         QKeySequence::Copy,
                         QKeySequence::Cut,
                         QKeySequence::Paste,
                         QKeySequence::SelectAll})
    if (key.matches(own)) return true;
  return false;
}

QString refusalOf(const QAction& action, const QString& why) {
  const QString own = action.property(kRefusalProperty).toString();
  return (own.isEmpty() ? action.text().remove('&').remove("…") : own) + ": " + why;
}

}  // namespace

GreyedKeys::GreyedKeys(QList<QAction*> actions,
                       std::function<QString(const QAction&)> why,
                       QWidget* window,
                       QObject* parent)
    : QObject(parent), actions_(std::move(actions)), why_(std::move(why)), window_(window) {
  KeyPolicy::ofApplication().install(KeyPolicy::Order::kGreyed, *this);
}

bool GreyedKeys::eventFilter(QObject* watched, QEvent* event) {
  // The key of an enabled action arrives as a shortcut, never as a KeyPress.
  if (event->type() != QEvent::KeyPress && event->type() != QEvent::ToolTip) return false;
  auto* widget = qobject_cast<QWidget*>(watched);
  if (!widget || !isWindowOrPartOf(*widget, window_)) return false;
  if (event->type() == QEvent::KeyPress) {
    const auto& key = *static_cast<QKeyEvent*>(event);
    return !belongsToField(*widget, key) && refuse(key);
  }
  auto* menu = qobject_cast<QMenu*>(widget);
  return menu && tell(*menu, *static_cast<QHelpEvent*>(event));
}

bool GreyedKeys::refuse(const QKeyEvent& key) {
  if (key.isAutoRepeat()) return false;
  const QKeySequence pressed(key.keyCombination());
  for (const QAction* action : actions_) {
    if (action->isEnabled() || !action->shortcuts().contains(pressed)) continue;
    const QString why = why_(*action);
    if (why.isEmpty()) continue;
    const bool same = key.timestamp() != 0 && key.timestamp() == lastPress_;
    lastPress_ = key.timestamp();
    if (!same) emit refused(refusalOf(*action, why), action);
    // What has the focus must not take it for text.
    return true;
  }
  return false;
}

bool GreyedKeys::tell(QMenu& menu, const QHelpEvent& event) const {
  QAction* action = menu.actionAt(event.pos());
  if (!action || action->isEnabled() || !actions_.contains(action)) return false;
  const QString why = why_(*action);
  if (why.isEmpty()) return false;
  QToolTip::showText(event.globalPos(), why, &menu);
  return true;
}

}  // namespace palpate::gui

#include "gui/hand/motion_keys.h"

#include <QApplication>
#include <QDialog>
#include <QKeyEvent>
#include <QWidget>
#include <utility>

namespace palpate::gui {
namespace {

// A dialogue keeps its keys to itself.
bool isWindowOrPartOf(const QWidget& widget, const QWidget* window) {
  const QWidget* top = widget.window();
  while (top != window && top->parentWidget() && !qobject_cast<const QDialog*>(top))
    top = top->parentWidget()->window();
  return top == window;
}

}  // namespace

QString refusalOf(const QAction& action) {
  return action.property(kRefusalProperty).toString() + ": " + action.toolTip();
}

MotionKeys::MotionKeys(QList<QAction*> actions, QWidget* window, QObject* parent)
    : QObject(parent), actions_(std::move(actions)), window_(window) {
  qApp->installEventFilter(this);
}

bool MotionKeys::eventFilter(QObject* watched, QEvent* event) {
  // The key of an enabled action arrives as a shortcut, never as a KeyPress.
  if (event->type() != QEvent::KeyPress) return false;
  const auto* widget = qobject_cast<QWidget*>(watched);
  const auto* key = static_cast<QKeyEvent*>(event);
  if (!widget || key->isAutoRepeat() || !isWindowOrPartOf(*widget, window_)) return false;
  const QKeySequence pressed(key->keyCombination());
  for (const QAction* action : actions_) {
    if (action->isEnabled() || !action->shortcuts().contains(pressed)) continue;
    const bool same = key->timestamp() != 0 && key->timestamp() == lastPress_;
    lastPress_ = key->timestamp();
    if (!same) {
      emit refusedAction(action);
      emit refused(refusalOf(*action));
    }
    // What has the focus must not take it for text.
    return true;
  }
  return false;
}

}  // namespace palpate::gui

#include "gui/hand/motion_button.h"

#include <QVariant>
#include <QWidget>

namespace palpate::gui {
namespace {
constexpr const char* kHadFocusProperty = "hadFocus";

// Null: there is none.
QWidget* keeperOf(const QWidget& button) {
  for (QWidget* part = button.parentWidget(); part; part = part->parentWidget()) {
    if ((part->focusPolicy() & Qt::ClickFocus) != 0) return part;
    if (part->isWindow()) break;
  }
  return nullptr;
}

}  // namespace

void enableMotionButton(QWidget& button, bool on) {
  const QWidget* window = button.window();
  if (!on && window->focusWidget() == &button) {
    // Nobody is not enough: when the window is activated again, Qt gives the focus to its first
    // button.
    if (QWidget* keeper = keeperOf(button))
      keeper->setFocus();
    else
      button.clearFocus();
    button.setProperty(kHadFocusProperty, true);
  }
  button.setEnabled(on);
  if (!on || !button.property(kHadFocusProperty).toBool()) return;
  button.setProperty(kHadFocusProperty, false);
  if (!window->focusWidget() || window->focusWidget() == keeperOf(button)) button.setFocus();
}

}  // namespace palpate::gui

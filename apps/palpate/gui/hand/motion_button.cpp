#include "gui/hand/motion_button.h"

#include <QVariant>
#include <QWidget>

namespace palpate::gui {
namespace {
constexpr const char* kHadFocusProperty = "hadFocus";
}  // namespace

void enableMotionButton(QWidget& button, bool on) {
  const QWidget* window = button.window();
  if (!on && window->focusWidget() == &button) {
    button.clearFocus();
    button.setProperty(kHadFocusProperty, true);
  }
  button.setEnabled(on);
  if (!on || !button.property(kHadFocusProperty).toBool()) return;
  button.setProperty(kHadFocusProperty, false);
  if (!window->focusWidget()) button.setFocus();
}

}  // namespace palpate::gui

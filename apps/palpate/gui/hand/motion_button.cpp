#include "gui/hand/motion_button.h"

#include <QPushButton>
#include <QVariant>

#include "gui/desktop/key_policy.h"
#include "gui/widgets/make.h"

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

QPushButton* motionButton(
    const QString& text, const QString& name, const QString& tip, bool moves, QWidget* parent) {
  auto* made = makeButton(parent, name, text, tip);
  made->setFocusPolicy(Qt::TabFocus);
  made->setProperty(kMovesHand, moves);
  return made;
}

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

QString busyText(const GraspStatus& status) {
  if (status.phase == GraspPhase::kIdle) return {};
  if (!status.request)
    return status.phase == GraspPhase::kHolding ? "A sequence runs; Stop (Esc) ends it"
                                                : "A motion is ending; wait until it has ended";
  const GraspRequest& request = *status.request;
  const bool holds = status.phase == GraspPhase::kHolding || status.phase == GraspPhase::kSettling;
  const QString how = holds ? " holds; Stop (Esc) ends it" : " runs; Stop (Esc) ends it";
  if (isOpening(request)) return "The hand opens; Stop (Esc) ends it";
  if (isJointMotion(request)) return "A motion of joints" + how;
  switch (request.mode) {
    case GraspMode::kSlip:
      return "A slip-aware grasp" + how;
    case GraspMode::kReactive:
      return "A reactive grasp" + how;
    case GraspMode::kPlain:
      break;
  }
  return "A plain grasp" + how;
}

}  // namespace palpate::gui

#include "gui/hand/stop_key.h"

#include <QKeyEvent>

#include "gui/desktop/key_policy.h"

namespace palpate::gui {

StopKey::StopKey(QObject* parent) : QObject(parent) {
  KeyPolicy::ofApplication().install(KeyPolicy::Order::kStop, *this);
}

bool StopKey::eventFilter(QObject* /*watched*/, QEvent* event) {
  const QEvent::Type type = event->type();
  const bool begins = type == QEvent::ShortcutOverride || type == QEvent::KeyPress;
  if (!control_ || (!begins && type != QEvent::KeyRelease)) return false;
  auto* key = static_cast<QKeyEvent*>(event);
  if (key->key() != Qt::Key_Escape) return false;
  if (type == QEvent::KeyRelease) {
    const bool ours = swallow_ && !key->isAutoRepeat();
    if (ours) swallow_ = false;
    return ours;
  }
  const bool same = key->timestamp() != 0 && key->timestamp() == lastPress_;
  if (!same && !key->isAutoRepeat()) {
    lastPress_ = key->timestamp();
    const GraspStatus status = control_->status();
    const bool moves =
        status.phase != GraspPhase::kIdle || (status.cannotMove.empty() && actsByItself());
    // A KeyPress follows the ShortcutOverride of the same press and finds the hand stopping or
    // stopped.
    swallow_ = moves || (swallow_ && type == QEvent::KeyPress);
    control_->stop();
    emit pressed();
  }
  if (swallow_) event->accept();
  return swallow_;
}

}  // namespace palpate::gui

#include "gui/desktop/termination.h"

#include <QSocketNotifier>

namespace palpate::gui {

Termination::Termination(QObject* parent) : QObject(parent) {
  auto* notifier = new QSocketNotifier(interruption_.descriptor(), QSocketNotifier::Read, this);
  connect(notifier, &QSocketNotifier::activated, this, [this] {
    if (interruption_.waitForSignal(0)) emit asked();
  });
}

}  // namespace palpate::gui

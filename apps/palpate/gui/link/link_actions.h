// What alarms and other programs do, as actions.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct LinkActions {
  explicit LinkActions(ActionRegistry& book);

  QAction* muteAlarms = nullptr;
  // other programs; off in a new window
  QAction* streamSignals = nullptr;
  QAction* streamTactile = nullptr;
  // data(): its socket; none: the usual one
  QAction* remoteControl = nullptr;
};

}  // namespace palpate::gui

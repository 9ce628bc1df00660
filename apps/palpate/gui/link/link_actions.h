// The actions that mute alarms and switch the interfaces for other programs.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct LinkActions {
  explicit LinkActions(ActionRegistry& book);

  QAction* muteAlarms = nullptr;
  // Streams of live data to other programs; the settings store whether they are on.
  QAction* streamSignals = nullptr;
  QAction* streamTactile = nullptr;
  // Off in every new window. data() is the path of the socket; empty: the default path.
  QAction* remoteControl = nullptr;
};

}  // namespace palpate::gui

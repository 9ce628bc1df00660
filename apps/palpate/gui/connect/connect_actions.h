// What connects, and shows what is connected, as actions.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct ConnectActions {
  explicit ConnectActions(ActionRegistry& book);

  QAction* connectHand = nullptr;
  QAction* tryEmulated = nullptr;
  QAction* disconnectHand = nullptr;
  // checked: what is connected is shown, not a recording
  QAction* live = nullptr;
  QAction* hold = nullptr;
};

}  // namespace palpate::gui

// The actions that connect to a hand and show the connected hand.
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
  // Checked while the connection is shown instead of a recording.
  QAction* live = nullptr;
  QAction* hold = nullptr;
};

}  // namespace palpate::gui

// The actions that move the connected hand; they do the same as the buttons of the dock Hand.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct HandActions {
  explicit HandActions(ActionRegistry& book);

  QAction* graspHand = nullptr;
  QAction* reactiveGrasp = nullptr;
  QAction* slipAwareGrasp = nullptr;
  QAction* openHand = nullptr;
  QAction* relaxHand = nullptr;
  // Esc does the same, whichever window has the keyboard focus.
  QAction* stopHand = nullptr;
};

}  // namespace palpate::gui

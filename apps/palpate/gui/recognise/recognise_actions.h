// What asks what is held, as actions.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct RecogniseActions {
  explicit RecogniseActions(ActionRegistry& book);

  // recognition of the selection, or of what is held
  QAction* whatIsIt = nullptr;
  // its answer on the whole screen
  QAction* presentationMode = nullptr;
};

}  // namespace palpate::gui

// The actions of recognition.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct RecogniseActions {
  explicit RecogniseActions(ActionRegistry& book);

  // Recognises the selection, or what is held.
  QAction* whatIsIt = nullptr;
  // Shows the answer on the full screen.
  QAction* presentationMode = nullptr;
};

}  // namespace palpate::gui

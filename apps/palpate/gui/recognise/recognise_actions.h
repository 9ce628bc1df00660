// What asks what is held, as actions.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/bench/action_book.h"

namespace palpate::gui {

struct RecogniseActions {
  explicit RecogniseActions(ActionBook& book);

  // recognition of the selection, or of what is held
  QAction* whatIsIt = nullptr;
  // its answer on the whole screen
  QAction* showMode = nullptr;
};

}  // namespace palpate::gui

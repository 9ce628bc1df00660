// What takes views away, as actions.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/bench/action_book.h"

namespace palpate::gui {

struct ExportActions {
  explicit ExportActions(ActionBook& book);

  QAction* exportPicture = nullptr;
  QAction* exportAgain = nullptr;
  QAction* copyPicture = nullptr;
  QAction* copyTable = nullptr;
};

}  // namespace palpate::gui

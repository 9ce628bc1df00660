// The actions that export or copy views.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct ExportActions {
  explicit ExportActions(ActionRegistry& book);

  QAction* exportPicture = nullptr;
  QAction* exportAgain = nullptr;
  QAction* copyPicture = nullptr;
  QAction* copyTable = nullptr;
};

}  // namespace palpate::gui

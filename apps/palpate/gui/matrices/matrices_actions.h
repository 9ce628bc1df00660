// The actions of the heat maps, including those that choose which taxels the hand scans.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct MatricesActions {
  explicit MatricesActions(ActionRegistry& book);

  QAction* interpolated = nullptr;
  QAction* values = nullptr;
  QAction* nextMap = nullptr;
  QAction* nextRange = nullptr;
  // Set the mask of scanned taxels from the selected taxels.
  QAction* scanOnly = nullptr;
  QAction* scanWithout = nullptr;
  QAction* scanAlso = nullptr;
  QAction* scanAll = nullptr;
  QAction* chooseNone = nullptr;
  QActionGroup* maps = nullptr;
  QActionGroup* ranges = nullptr;
};

}  // namespace palpate::gui

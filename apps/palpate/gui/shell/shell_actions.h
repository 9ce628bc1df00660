// The actions of the main window itself.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct ShellActions {
  explicit ShellActions(ActionRegistry& book);

  QAction* quit = nullptr;
  QAction* nextTheme = nullptr;
  QAction* fullScreen = nullptr;
  QAction* resetLayout = nullptr;
  QAction* dismiss = nullptr;
  QActionGroup* themes = nullptr;
};

}  // namespace palpate::gui

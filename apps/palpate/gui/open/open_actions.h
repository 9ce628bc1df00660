// The actions that open, close and switch between recordings.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct OpenActions {
  explicit OpenActions(ActionRegistry& book);

  QAction* open = nullptr;
  QAction* openDemo = nullptr;
  QAction* nextRecording = nullptr;
  QAction* previousRecording = nullptr;
  QAction* closeRecording = nullptr;
};

}  // namespace palpate::gui

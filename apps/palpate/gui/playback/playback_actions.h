// The actions that play a recording.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct PlaybackActions {
  explicit PlaybackActions(ActionRegistry& book);

  QAction* play = nullptr;
  QAction* stepBack = nullptr;
  QAction* stepForward = nullptr;
  QAction* tenBack = nullptr;
  QAction* tenForward = nullptr;
  QAction* toStart = nullptr;
  QAction* toEnd = nullptr;
  QAction* goToFrame = nullptr;
  QAction* faster = nullptr;
  QAction* slower = nullptr;
  QAction* loop = nullptr;
  QAction* skipGaps = nullptr;
  QActionGroup* speeds = nullptr;
};

}  // namespace palpate::gui

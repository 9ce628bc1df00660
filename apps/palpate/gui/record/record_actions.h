// The actions that record and mark.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct RecordActions {
  explicit RecordActions(ActionRegistry& book);

  QAction* record = nullptr;
  QAction* recordingSettings = nullptr;
  // Opens the last recording that was made.
  QAction* openRecorded = nullptr;
  QAction* mark = nullptr;
  // For the digit keys 0..9.
  QList<QAction*> labels;
};

}  // namespace palpate::gui

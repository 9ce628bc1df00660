// What records and marks, as actions.
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
  // what was recorded last
  QAction* openRecorded = nullptr;
  QAction* mark = nullptr;
  // of the digit keys 0..9
  QList<QAction*> labels;
};

}  // namespace palpate::gui

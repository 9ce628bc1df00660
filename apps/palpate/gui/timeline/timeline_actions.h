// The actions of the timeline, its selection and its events.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct TimelineActions {
  explicit TimelineActions(ActionRegistry& book);

  QAction* saveEvents = nullptr;
  QAction* undo = nullptr;
  QAction* redo = nullptr;
  QAction* addLabel = nullptr;
  QAction* addNote = nullptr;
  QAction* addGrasp = nullptr;
  QAction* renameEvent = nullptr;
  QAction* removeEvent = nullptr;
  QAction* nextEvent = nullptr;
  QAction* previousEvent = nullptr;
  QAction* toEvents = nullptr;
  QAction* selectFrom = nullptr;
  QAction* selectTo = nullptr;
  QAction* selectAll = nullptr;
  QAction* crop = nullptr;
  QAction* saveAs = nullptr;
  QAction* zoomSelection = nullptr;
  QAction* dropSelection = nullptr;
  // Statistics of the curves over the selection.
  QAction* statistics = nullptr;
  // Shows the differences between the ends of the selection in the chart.
  QAction* differences = nullptr;
  // Sets the vertical axes by hand.
  // Makes a named group of the selected taxels.
  QAction* nameTaxels = nullptr;
  // Makes a curve by a formula or a filter.
  QAction* newFormula = nullptr;
  QAction* chooseCurves = nullptr;
  QAction* zoomIn = nullptr;
  QAction* zoomOut = nullptr;
  QAction* fit = nullptr;
  // Range of the vertical axes.
  QAction* axes = nullptr;
  // The live chart: freeze it, scroll it, move its cursors.
  QAction* freeze = nullptr;
  QAction* lanes = nullptr;
  QAction* newest = nullptr;
  QAction* oldest = nullptr;
  QAction* earlier = nullptr;
  QAction* later = nullptr;
  QAction* cursorBack = nullptr;
  QAction* cursorForward = nullptr;
  // The rest of the connected hand, and of the selection of a recording.
  QAction* takeBaseline = nullptr;
  QAction* undoBaseline = nullptr;
  QAction* baselineOfSelection = nullptr;
  QActionGroup* signalsPlotted = nullptr;
};

}  // namespace palpate::gui

// Edits events (labels, notes and grasps) in the rows below the timeline and by keys, with undo.
#pragma once

#include <QObject>
#include <QString>
#include <cstddef>
#include <optional>

#include "gui/timeline/timeline_actions.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

class EventRows;

class EventEditing : public QObject {
  Q_OBJECT
 public:
  // All arguments must outlive this object.
  EventEditing(WindowState& windowState, const TimelineActions& actions, EventRows& rows);

 private:
  void connectActions();
  void connectRows();
  void addConditions();
  void add(const char* kind, const QString& title, const QString& name);
  void addGrasp();
  void rename();
  void choose(const Event& made);
  void chooseEvent(const Event& event);
  void show(std::size_t mark);
  void showUndo();
  // Goes on from the chosen event as long as the cursor stands on it, else from the cursor; in the
  // row of the event that was shown last.
  void goToNext(int step);

  WindowState& windowState_;
  const TimelineActions& actions_;
  EventRows& rows_;
  // Where show() left the cursor [s]; nothing: no event was shown.
  std::optional<double> shownAtS_;
  // The row of the event that show() showed last; nothing: none since none was chosen.
  std::optional<EventLane> walkedLane_;
};

}  // namespace palpate::gui

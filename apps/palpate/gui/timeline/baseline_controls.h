// Takes the readings at rest, and shows which are in force: of the last second of the connected
// hand, or of the selection of a recording. Of a hand that decides touch by its readings they are
// its baseline, an event; of any other hand they make a filter.
#pragma once

#include <QObject>
#include <QString>
#include <memory>

#include <palpate/model/touch.h>

#include "gui/source/background_job.h"
#include "gui/timeline/timeline_actions.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

class BaselineControls : public QObject {
  Q_OBJECT
 public:
  // All arguments must outlive this object.
  BaselineControls(WindowState& windowState, const TimelineActions& actions);
  // Waits until a selection has been read; for tests.
  void wait() { reading_.settle(); }

 private:
  void take();
  void undo();
  bool canUndo() const;
  void takeOfSelection();
  void tell(const QString& taken);
  // Shows why no baseline was taken, until one is.
  void refuse(const QString& why);
  // Puts the baseline in force into the tool tip of the action and into the status line.
  void showInForce();
  QString inForce();
  // Replaces the filter "baseline" of the chain; without one, it becomes the first filter.
  void putFilter(FilterStep step);

  WindowState& windowState_;
  QAction& takeBaseline_;
  const QString tip_;  // of the action
  // What is in force for the live source, in words; empty: not known yet.
  QString live_;
  // The last event of the live source has decided it; before, its frames do (a replay).
  bool liveByEvent_ = false;
  // Of the frame that was shown last.
  std::shared_ptr<const Baseline> seen_;
  // The chain as putFilter() left it.
  Recipe put_;
  BackgroundJob reading_{BackgroundJob::Leaving::kAtOnce};
};

}  // namespace palpate::gui

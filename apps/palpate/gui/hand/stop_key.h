// Stops the hand when Escape is pressed anywhere in the program: in a field, a menu, a dialog,
// another window. Used by HandDock.
#pragma once

#include <QObject>
#include <functional>

#include <palpate/control/grasp_control.h>

namespace palpate::gui {

class StopKey : public QObject {
  Q_OBJECT
 public:
  explicit StopKey(QObject* parent);
  // Sets the hand; null: Escape has only its usual meaning. `control` must outlive this, or be
  // replaced by null before it is destroyed.
  void setControl(GraspControl* control) { control_ = control; }
  // Whether the hand moves or holds by itself, as in a scene of the emulated hand.
  std::function<bool()> actsByItself = [] { return false; };

 signals:
  void pressed();

 protected:
  // Sees the events of the whole application. While the hand moves, Escape only stops it; otherwise
  // the stop is sent too, and the key also goes to the focused widget.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  GraspControl* control_ = nullptr;
  // Time stamp of the last press: one press arrives as several events.
  quint64 lastPress_ = 0;
  // The remaining events of a press that stopped a motion are not passed on.
  bool swallow_ = false;
};

}  // namespace palpate::gui

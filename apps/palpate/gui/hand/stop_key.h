// Escape stops the hand, wherever in the program the keyboard is: in a field, a menu, a dialogue,
// another window.
#pragma once

#include <QObject>

#include <palpate/control/grasp_control.h>

namespace palpate::gui {

class StopKey : public QObject {
  Q_OBJECT
 public:
  explicit StopKey(QObject* parent);
  // Whose hand; null: Escape means what it always means. Must outlive this, or be taken away
  // before.
  void setControl(GraspControl* control) { control_ = control; }

 signals:
  void pressed();

 protected:
  // Of the whole application. While the hand moves Escape does nothing but stop it; else it goes on
  // to whoever has the focus, and the stop goes out all the same.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  GraspControl* control_ = nullptr;
  quint64 lastPress_ = 0;  // time stamp: one press comes as several events
  bool swallow_ = false;   // the rest of a press that stopped a motion
};

}  // namespace palpate::gui

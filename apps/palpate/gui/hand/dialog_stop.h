// While a modal dialogue is open, the window's buttons are dead, and a large dialogue may lie over
// them; so each modal dialogue, and each other one that asks for it (kWantsStopProperty), gets a
// button Stop of its own as long as a hand is connected that can be moved; the line beside it says
// whether a stop can reach the hand. (Esc works everywhere.)
#pragma once

#include <QAction>
#include <QDialog>
#include <QObject>

class QLabel;

namespace palpate::gui {

class DialogStop : public QObject {
 public:
  // `stop`: the action that stops the hand; enabled while there is a hand to stop. It must outlive
  // this object.
  DialogStop(QAction& stop, QObject* parent);
  // Whether the hand answers; false: its motion port is disconnected, for example.
  void setReached(bool reached);
  // Whether its fingers move, so that a stop is urgent.
  void setMoving(bool moving);

 protected:
  // Filters the events of the whole application.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void showIn(QDialog& dialog);
  // A dialogue that isn't modal stays open while a hand is connected or disconnected.
  void follow(QDialog& dialog);

  void showState(QLabel& state) const;
  void showStates() const;

  QAction& stop_;
  bool reached_ = true;
  bool moving_ = false;
};

}  // namespace palpate::gui

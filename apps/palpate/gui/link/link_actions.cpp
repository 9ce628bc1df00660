#include "gui/link/link_actions.h"

namespace palpate::gui {

LinkActions::LinkActions(ActionRegistry& book) {
  muteAlarms = book.make("muteAlarms", "Hand", "&Silent alarms", {key("Ctrl+Shift+M")}, true);
  streamSignals = book.make("streamSignals", "Hand", "Stream signals to &PlotJuggler", {}, true);
  streamSignals->setToolTip("A datagram of JSON per frame, to this machine only");
  streamTactile =
      book.make("streamTactile", "Hand", "Stream all &taxels (ROS TactileSensor)", {}, true);
  streamTactile->setToolTip("A datagram of JSON per frame, to this machine only");
  remoteControl = book.make("remoteControl", "Hand", "&Remote control", {}, true);
  remoteControl->setToolTip("Your programs can start, stop and label recordings");
}

}  // namespace palpate::gui

// Fills the status line, the text beside the button Connect and the chip of the hand, with the
// state of the displayed source and of the connected hand.
#pragma once

#include <QObject>

#include "gui/shell/window_menus.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

struct Status;
class StatusStrip;

class StatusReport : public QObject {
  Q_OBJECT
 public:
  // All arguments must outlive this object.
  StatusReport(WindowState& windowState, StatusStrip& strip, WindowMenus& menus);

 private:
  void report();
  void reportLive();
  void reportLink();
  void reportHand();
  void showBaseline(Status& now) const;
  QString notice() const;
  QString chosenTaxels() const;

  WindowState& windowState_;
  StatusStrip& strip_;
  WindowMenus& menus_;
};

}  // namespace palpate::gui

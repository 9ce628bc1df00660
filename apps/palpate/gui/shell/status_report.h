// The status line, and what stands beside the button Connect: what is shown, how it goes, in a few
// words.
#pragma once

#include <QObject>

#include "gui/shell/window_menus.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

class StatusStrip;

class StatusReport : public QObject {
  Q_OBJECT
 public:
  // All of them must outlive it.
  StatusReport(WindowState& windowState, StatusStrip& strip, WindowMenus& menus);

 private:
  void report();
  void reportLive();
  void reportLink();
  QString notice() const;
  QString chosenTaxels() const;

  WindowState& windowState_;
  StatusStrip& strip_;
  WindowMenus& menus_;
};

}  // namespace palpate::gui

// The menu of presets: layouts of the docks for a task, with a key each, and the user's own ones.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QMenu>
#include <QObject>

#include "gui/window_state/feature.h"

namespace palpate::gui {

class DockArrangement;

class LayoutMenu : public QObject {
  Q_OBJECT
 public:
  // Makes the actions. All arguments must outlive this object.
  LayoutMenu(WindowState& windowState, DockArrangement& docks, QMenu& menu);
  // To be called once all actions exist.
  void begin();

 private:
  void use(Preset preset);
  void renew();
  void keep();

  WindowState& windowState_;
  DockArrangement& docks_;
  QMenu& menu_;
  QActionGroup presets_;
  QAction* keep_;
  QAction* remove_;
  QAction* reset_;
  QAction* show_ = nullptr;
};

}  // namespace palpate::gui

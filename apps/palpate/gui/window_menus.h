// Menu bar and toolbar, built from the actions.
#pragma once

#include <QList>

class QAction;
class QComboBox;
class QMainWindow;
class QMenu;
class QToolButton;
class QWidget;

namespace palpate::gui {

struct Actions;

struct WindowMenus {
  // dockToggles: what shows and hides the docks.
  WindowMenus(QMainWindow& window, const Actions& actions, const QList<QAction*>& dockToggles);

  // Buttons without text, for a narrow window.
  void setCompact(bool on);

  QMenu* recent;              // filled by its owner when it is about to show
  QComboBox* speed;           // of the toolbar; index into PlaybackController::kSpeeds
  QComboBox* recordings;      // open recordings
  QAction* recordingsAction;  // shows and hides it

 private:
  QList<QToolButton*> withText_;
  QWidget* play_;
  void buildMenuBar(QMainWindow& window, const Actions& actions, const QList<QAction*>& toggles);
  void buildToolBar(QMainWindow& window, const Actions& actions);
};

}  // namespace palpate::gui

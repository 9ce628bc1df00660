// Menu bar and toolbar, built from the actions.
#pragma once

#include <QList>
#include <QString>

#include "gui/bench/menus.h"

class QAction;
class QLabel;
class QMainWindow;
class QMenu;
class QToolBar;
class QToolButton;
class QWidget;

namespace palpate::gui {

struct Actions;

class WindowMenus {
 public:
  WindowMenus(QMainWindow& window, const Actions& actions);

  // What shows and hides the docks, in the menu View.
  void addDocks(const QList<QAction*>& toggles);
  // What features fill, or open elsewhere, too.
  Menus shared() const;

  // Buttons without text, for a narrow window.
  void setCompact(bool on);
  void setPlaybackShown(bool on);
  // What is connected; empty: nothing is shown. `good`: data come.
  void showLink(const QString& text, bool good);

 private:
  QAction* resetLayout_;  // behind the docks
  QMenu* view_ = nullptr;
  Menus menus_;
  QLabel* link_ = nullptr;         // beside Connect: what is connected, in a word
  QToolButton* record_ = nullptr;  // red while it records
  QList<QToolButton*> withText_;
  QToolButton* play_ = nullptr;
  QAction* playback_ = nullptr;
  QAction* linkAction_ = nullptr;
  bool compact_ = false;

  void styleRecord();
  void showRecording(bool on);  // the button turns red
  void buildMenuBar(QMainWindow& window, const Actions& actions);
  void buildToolBar(QMainWindow& window, const Actions& actions);
  QWidget* makePlayback(QToolBar& bar, const Actions& actions);
};

}  // namespace palpate::gui

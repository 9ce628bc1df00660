// Menu bar and toolbar, filled with the actions of the features.
#pragma once

#include <QList>
#include <QMap>
#include <QString>

#include "gui/window_state/menus.h"

class QAction;
class QLabel;
class QMainWindow;
class QMenu;
class QToolBar;
class QToolButton;
class QWidget;

namespace palpate::gui {

class ActionRegistry;

class WindowMenus {
 public:
  explicit WindowMenus(QMainWindow& window);

  // Once all actions are made: in the order that is written down here; others at the end of the
  // menu of their section. `dockToggles`: what shows and hides the docks, in the menu View.
  void fill(const ActionRegistry& book, const QList<QAction*>& dockToggles);
  // What features fill, or open elsewhere, too.
  Menus shared() const;

  // Buttons without text, for a narrow window.
  void setCompact(bool on);
  void setPlaybackShown(bool on);
  // What is connected; empty: nothing is shown. `good`: data come.
  void showLink(const QString& text, bool good);

 private:
  QMainWindow& window_;
  QMap<QString, QMenu*> sections_;  // by title
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
  void buildMenuBar(const ActionRegistry& book, const QList<QAction*>& dockToggles);
  void buildToolBar(const ActionRegistry& book);
  void addOthers(const ActionRegistry& book);
  QWidget* makePlayback(QToolBar& bar, const ActionRegistry& book);
};

}  // namespace palpate::gui

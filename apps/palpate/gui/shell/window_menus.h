// Builds the menu bar and the toolbar from the actions of the features.
#pragma once

#include <QList>
#include <QMap>
#include <QString>

#include "gui/appearance/theme.h"
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
class HandChip;
class HandCommands;

class WindowMenus {
 public:
  explicit WindowMenus(QMainWindow& window);

  // To be called once all actions exist. The order of the menus is written in the source; actions
  // that it doesn't name come at the end of the menu of their section. `dockToggles`: actions that
  // show and hide the docks, for the menu View.
  void fill(const ActionRegistry& book, const QList<QAction*>& dockToggles);
  // The menus and boxes that features fill or also open elsewhere.
  Menus shared() const;

  // Shows buttons without text, for a narrow window.
  void setCompact(bool on);
  // Leaves the name of the program out of the tool bar.
  void setNarrow(bool on, bool isRecordingShown);
  void setPlaybackShown(bool on);
  // Shows what is connected; empty: shows nothing. `good`: data arrive.
  void showLink(const QString& text, bool good);
  int chipWidth() const;  // [px]; 0: there is no chip of a hand
  // Shows the condition of the connected hand; nothing: no hand is connected that can be moved.
  void showHand(const HandCommands& hand);

 private:
  QMainWindow& window_;
  // The menus by title.
  QMap<QString, QMenu*> sections_;
  Menus menus_;
  // Beside Connect: what is connected, in short.
  QLabel* link_ = nullptr;
  HandChip* chip_ = nullptr;
  QAction* chipShown_ = nullptr;
  // Red while recording.
  QToolButton* record_ = nullptr;
  QList<QToolButton*> withText_;
  QToolButton* play_ = nullptr;
  QAction* playback_ = nullptr;
  QAction* linkAction_ = nullptr;
  QAction* brand_ = nullptr;
  bool compact_ = false;

  void styleRecord();
  // The text that names the plan gets the room that is free in the bar.
  void fitRecord(const QToolBar& bar);
  void setPlayWidth();
  // Turns the button red.
  void showRecording(bool on);
  void buildMenuBar(const ActionRegistry& book, const QList<QAction*>& dockToggles);
  void buildToolBar(const ActionRegistry& book);
  void addOthers(const ActionRegistry& book);
  void addStop(QToolBar& bar, QAction* stop);
  QWidget* makePlayback(QToolBar& bar, const ActionRegistry& book);
};

}  // namespace palpate::gui

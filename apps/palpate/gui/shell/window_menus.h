// Builds the menu bar and the toolbar from the actions of the features.
#pragma once

#include <QList>
#include <QMap>
#include <QString>
#include <vector>

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
  // Actions and menus that are of use only while a hand is connected, and only with recordings.
  const QList<QAction*>& ofHand() const noexcept { return ofHand_; }
  const QList<QAction*>& ofRecordings() const noexcept { return ofRecordings_; }
  // The menus and boxes that features fill or also open elsewhere.
  Menus shared() const;

  void setPlaybackShown(bool on);
  // Shows what is connected; empty: shows nothing. `good`: data arrive.
  void showLink(const QString& text, bool good);
  // Shows the condition of the connected hand; nothing: no hand is connected that can be moved.
  void showHand(const HandCommands& hand);

 private:
  QMainWindow& window_;
  // The menus by title.
  QMap<QString, QMenu*> sections_;
  Menus menus_;
  QList<QAction*> ofHand_, ofRecordings_;
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
  bool compact_ = false;
  QToolBar* bar_ = nullptr;
  // What fitBar() found last: it is called again for what it changes itself.
  std::vector<int> fitted_;

  void styleRecord();
  // Words give way when there is no room for them. The text that names the plan gets what is free.
  void fitBar();
  void setCompact(bool on);
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

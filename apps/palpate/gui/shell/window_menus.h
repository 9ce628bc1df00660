// Menu bar and toolbar, built from the actions.
#pragma once

#include <QList>
#include <QString>

class QAction;
class QComboBox;
class QLabel;
class QMainWindow;
class QMenu;
class QToolBar;
class QToolButton;
class QWidget;

namespace palpate::gui {

struct Actions;

struct WindowMenus {
  // dockToggles: what shows and hides the docks.
  WindowMenus(QMainWindow& window, const Actions& actions, const QList<QAction*>& dockToggles);

  // Buttons without text, for a narrow window.
  void setCompact(bool on);
  void setPlaybackShown(bool on);
  // What is connected; empty: nothing is shown. `good`: data come.
  void showLink(const QString& text, bool good);
  void showRecording(bool on);  // the button turns red

  QMenu* edit;                // also shown over the timeline
  QMenu* connections;         // of the button Connect; filled by its owner when it is about to show
  QMenu* only = nullptr;      // one matrix of the hand in space alone
  QMenu* scanned;             // which taxels are scanned; also shown over the matrices
  QLabel* link;               // beside Connect: what is connected, in a word
  QToolButton* record;        // red while it records
  QMenu* recent;              // filled by its owner when it is about to show
  QComboBox* speed;           // of the toolbar; index into PlaybackController::kSpeeds
  QComboBox* recordings;      // open recordings
  QAction* recordingsAction;  // shows and hides it

 private:
  QList<QToolButton*> withText_;
  QToolButton* play_;
  QAction* playback_;
  bool compact_ = false;
  void styleRecord();
  QAction* linkAction_;
  void buildMenuBar(QMainWindow& window, const Actions& actions, const QList<QAction*>& toggles);
  void buildToolBar(QMainWindow& window, const Actions& actions);
  QWidget* makePlayback(QToolBar& bar, const Actions& actions);
};

}  // namespace palpate::gui

// The one main window: start page or heat maps in the middle, the timeline below, Inspect beside.
// It wires the parts together; what it remembers is in ViewSettings and the layout's state.
#pragma once

#include <QMainWindow>
#include <QSettings>
#include <QStackedWidget>
#include <QThreadPool>
#include <QTimer>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/core/time.h>

#include "gui/actions.h"
#include "gui/matrices_painter.h"
#include "gui/playback_controller.h"
#include "gui/recent_files.h"
#include "gui/recording_opener.h"
#include "gui/window_menus.h"
#include "gui/window_settings.h"

namespace palpate::gui {

class Dock;
class HandDock;
class InspectPanel;
class MatricesPanel;
class MessageBanner;
class OpeningStrip;
class PlaybackBar;
class StartPage;
class StatusStrip;
class TimelineChart;
class TimelineHeader;

// What the window takes from outside; tests hand in their own.
struct WindowSurroundings {
  std::filesystem::path dataFolder;  // with the demo recording
  QString settingsPath;              // INI file
  const Clock* clock = nullptr;      // null: the system's
  RecordingOpener::Read read = {};   // empty: openRecording
};

class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(const WindowSurroundings& surroundings);
  ~MainWindow() override;

  // Opens in the background; the first that can be opened is shown, the others can be reached.
  void openFiles(const std::vector<std::filesystem::path>& files);
  // The demo recording, playing in a loop.
  void openDemo();
  void setTheme(ThemeChoice choice);
  QStringList dockNames() const;
  void showDock(const QString& name);  // one of dockNames()

  HandDock& hand() noexcept { return *hand_; }  // told of a hand by whoever connects one
  PlaybackController& playback() noexcept { return playback_; }
  RecordingOpener& opener() noexcept { return opener_; }
  const Actions& actionList() const noexcept { return actions_; }
  const OpenedRecordingPtr& current() const noexcept { return current_; }
  const std::vector<OpenedRecordingPtr>& recordings() const noexcept { return recordings_; }
  const ViewSettings& viewSettings() const noexcept { return view_; }

  // How files are asked for; an empty answer means cancelled. Tests answer themselves.
  std::function<QStringList()> askForRecordings;
  std::function<QString(const QString& suggestion)> askForPicture;
  // Waits until pictures being written are on disk.
  void waitForExports() { workers_.waitForDone(); }

 signals:
  void recordingShown();
  void pictureWritten(const QString& path);

 protected:
  void closeEvent(QCloseEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dragLeaveEvent(QDragLeaveEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  // main_window.cpp: parts, opening, recordings
  void buildParts(const std::filesystem::path& dataFolder);
  void buildDocks();
  void connectOpening();
  void connectFileActions();
  void askAndOpen();
  void fillRecentMenu();
  void addRecording(const OpenedRecordingPtr& recording);
  void showRecording(const OpenedRecordingPtr& recording);
  void showNeighbour(int step);
  void closeCurrent();
  void listRecordings();
  void exportPicture();
  void copyPicture();
  // main_window_actions.cpp: what actions and controls do
  void connectPlayback();
  void connectViewActions();
  void connectChoices();
  // main_window_view.cpp: look, status, layout
  void changeView(const std::function<void(ViewSettings&)>& change);
  void applyView();
  void applyTheme();
  void showFrame(std::size_t frame);
  void showPlaybackState();
  void showPlotted();
  void updateStatus();
  QString noticeNow() const;
  void flash(const QString& notice);
  void setPlaceForRecording(bool there);
  void defaultLayout();
  void enableActions();
  void dismiss();
  void toggleFullScreen(bool on);
  void remember();
  MatricesPictureOptions exportOptions() const;

  QSettings settings_;
  RecentFiles recent_;
  ViewSettings view_;
  Actions actions_;
  PlaybackController playback_;
  RecordingOpener opener_;
  QThreadPool workers_;

  std::filesystem::path demoPath_;
  bool demoAsked_ = false;
  bool loopIsOfDemo_ = false;  // not the user's choice: not remembered
  bool shownOfBatch_ = false;  // the first of several files has been shown
  std::vector<OpenedRecordingPtr> recordings_;
  std::vector<std::size_t> lastFrames_;  // where each was left
  OpenedRecordingPtr current_;
  QByteArray layout_;  // of docks, while the start page hides them
  QString hover_;
  QString flash_;
  QTimer flashTimer_;
  bool sizedOnce_ = false;

  QStackedWidget* stack_ = nullptr;
  MessageBanner* banner_ = nullptr;
  OpeningStrip* opening_ = nullptr;
  StartPage* startPage_ = nullptr;
  MatricesPanel* matrices_ = nullptr;
  PlaybackBar* playbackBar_ = nullptr;
  TimelineHeader* timelineHeader_ = nullptr;
  TimelineChart* timeline_ = nullptr;
  InspectPanel* inspect_ = nullptr;
  HandDock* hand_ = nullptr;
  StatusStrip* status_ = nullptr;
  QList<Dock*> docks_;
  Dock* handDock_ = nullptr;  // one of them; hidden until it is asked for
  std::unique_ptr<WindowMenus> menus_;
};

}  // namespace palpate::gui

// The one main window: start page or heat maps in the middle, the timeline below, docks beside; of a recording
// or of what is connected. It wires the parts together; what it remembers is in ViewSettings and the layout's state.
#pragma once

#include <QMainWindow>
#include <QSettings>
#include <QSplitter>
#include <QStackedWidget>
#include <QTimer>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include <palpate/control/tactile_masks.h>
#include <palpate/core/time.h>
#include <palpate/recognition/grasp_segments.h>

#include "gui/bench/actions.h"
#include "gui/bench/activity_log.h"
#include "gui/chart/plotted_curve.h"
#include "gui/link/alarm_bell.h"
#include "gui/look/window_settings.h"
#include "gui/matrices/matrices_painter.h"
#include "gui/picture/exported_view.h"
#include "gui/record/unfinished_finder.h"
#include "gui/shell/window_menus.h"
#include "gui/source/background_job.h"
#include "gui/source/event_editor.h"
#include "gui/source/filter_worker.h"
#include "gui/source/live_controller.h"
#include "gui/source/open_recordings.h"
#include "gui/source/playback_controller.h"
#include "gui/source/recent_files.h"
#include "gui/source/recording_opener.h"
#include "gui/source/recording_settings.h"
#include "gui/source/session.h"
#include "gui/space/hand_look.h"
#include "gui/timeline/signal_tree.h"
#include "gui/timeline/taxel_groups.h"

namespace palpate::gui {

class ComparePanel;
class Dock;
class FilterPanel;
class HandDock;
class HandPanel;
class InspectPanel;
class LibraryPanel;
class LinkPanel;
class LiveChart;
class LogPanel;
class MatricesPanel;
class MatricesView;
class MessageBanner;
struct OldPicture;
class OfferStrip;
class OpeningStrip;
class PlaybackBar;
class StartPage;
class StatusStrip;
class SignalTree;
class SpectrumPanel;
class TakeAway;
class TimelineChart;
class TimelineHeader;
class TimelinePanel;

// What the window takes from outside; tests hand in their own.
struct WindowSurroundings {
  std::filesystem::path dataFolder;           // with the demo recording
  QString settingsPath;                       // INI file
  const Clock* clock = nullptr;               // null: the system's
  RecordingOpener::Read read = {};            // empty: openRecording
  std::vector<double> assumedAnglesDeg = {};  // of recordings without joint angles; empty: none
  std::optional<Recipe> recipe = {};          // switched on; nothing: what was there last
  bool offerUnfinished = false;  // recordings that an earlier day left, when the window opens
};

class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(const WindowSurroundings& surroundings);
  ~MainWindow() override;

  // Opens in the background; the first that can be opened is shown, the others can be reached. Or else, as `then` says.
  void openFiles(const std::vector<std::filesystem::path>& files,
                 OpenRequest::Then then = OpenRequest::Then::kShowFirst);
  // The demo recording, playing in a loop.
  void openDemoRecording();
  // What `palpate --demo` shows: the emulated hand, grasping a ball by itself.
  void openDemo();
  // What was open when the window was closed last, as it was.
  void restoreSession();
  // Ends what is connected before; never moves a hand.
  void connectTo(const Connection& connection);
  // Closes without asking: a recording is finished, a hand that moves is stopped.
  void endNow();
  void setTheme(ThemeChoice choice);
  QStringList dockNames() const;
  void showDock(const QString& name);  // one of dockNames()

  HandDock& hand() noexcept { return *hand_; }
  LiveController& live() noexcept { return live_; }
  // What is connected is shown, not a recording.
  bool liveShown() const noexcept { return liveShown_; }
  MatricesView& matricesView();
  HandPanel& handPanel() noexcept { return *handPanel_; }
  ComparePanel& compare() noexcept { return *compare_; }
  bool compareShown() const;
  PlaybackController& playback() noexcept { return playback_; }
  RecordingOpener& opener() noexcept { return opener_; }
  const Actions& actionList() const noexcept { return actions_; }
  const OpenedRecordingPtr& current() const noexcept { return current_; }
  const std::vector<OpenedRecordingPtr>& recordings() const noexcept { return recordings_.all(); }
  const ViewSettings& viewSettings() const noexcept { return view_; }

  // How files are asked for; an empty answer means cancelled. Tests answer themselves.
  std::function<QStringList()> askForRecordings;
  // Nothing: cancelled.
  std::function<std::optional<Connection>(const Connection& last)> askForConnection;
  // What a recording shall be called, before it begins or in between; nothing: cancelled.
  std::function<std::optional<RecordingSettings>(const RecordingSettings&, const QString& button)>
      askForRecording;
  // Whether a recording that runs may be ended now.
  std::function<bool()> askToEndRecording;
  // The text of a label or a note; nothing: cancelled. `title` says which, `text` is what it is now.
  std::function<std::optional<QString>(const QString& title, const QString& text)> askForText;
  // Where a part of a recording shall be saved; an empty answer means cancelled.
  std::function<QString(const QString& suggestion)> askForCropped;
  // Whether labels that aren't saved shall be.
  enum class Unsaved { kSave, kDiscard, kCancel };
  std::function<Unsaved(const QString& names)> askAboutUnsaved;
  TimelinePanel& timelinePanel() noexcept { return *timelinePanel_; }
  TaxelGroups& taxelGroups() noexcept { return groups_; }
  SignalTree& signalTree() noexcept { return *signalTree_; }
  // Of the recording that is shown; null: none.
  EventEditor* events();
  // Waits for what is read and written beside the window.
  void waitForWork();

  // Looks for recordings that were never finished, and offers to recover them.
  void offerUnfinished();
  UnfinishedFinder& unfinished() noexcept { return unfinished_; }
  // What can be taken away, and how it is asked for.
  TakeAway& takeAway() noexcept { return *takeAway_; }
  LibraryPanel& library() noexcept { return *library_; }
  FilterPanel& filter() noexcept { return *filter_; }
  // As it is seen: through the filters, where they are on.
  const OpenedRecordingPtr& shown() const noexcept { return shown_; }
  bool filteredShown() const;
  void waitForFilter() { filterWorker_.wait(); }
  SpectrumPanel& spectrum() noexcept { return *spectrum_; }
  const ActivityLog& activity() const noexcept { return activity_; }
  // Waits until what is being written is on disk.
  void waitForExports();

 signals:
  void recordingShown();
  void pictureWritten(const QString& path);
  void cropWritten(const QString& path);

 protected:
  void closeEvent(QCloseEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dragLeaveEvent(QDragLeaveEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  // main_window.cpp: parts, opening, recordings
  // Where the window is: with each place its own layout of docks.
  enum class Place { kStart, kRecording, kLive };
  void buildParts(const WindowSurroundings& surroundings);
  void buildDocks(const WindowSurroundings& surroundings);
  void connectOpening();
  void connectFileActions();
  void askAndOpen(OpenRequest::Then then = OpenRequest::Then::kShowFirst);
  void fillRecentMenu();
  void addRecording(const OpenedRecordingPtr& recording, const OpenArrival& arrival);
  // What was kept of a recording that is gone.
  void forget(const OpenedRecordingPtr& recording);
  void showRecording(const OpenedRecordingPtr& recording);
  void showNeighbour(int step);
  void closeCurrent();
  void listRecordings();
  QString pictureName() const;
  bool somethingIsShown() const;
  // main_window_takeaway.cpp: views as pictures and tables
  void connectTakeAway();
  ExportedView matricesExport();
  ExportedView timelineExport();
  ExportedView inspectExport();
  QString recordingStem() const;
  // main_window_timeline.cpp: curves, selection
  void connectTimeline();
  std::vector<PlottedCurve> curvesNow() const;
  void showCurves();
  void showSelection();
  void showReading();
  void selectEnd(bool begin);
  void nameChosenTaxels();
  void cropSelection();
  // main_window_spectrum.cpp
  void buildSpectrum();
  void placeSpectrum();
  void connectSpectrum();
  void showSpectrum();
  void makeRoomForSpectrum();
  ExportedView spectrumExport();
  // main_window_events.cpp: rows of events
  void connectEvents();
  void showEvents();
  void enableEventActions();
  void eventChosen(std::size_t mark);
  void addEvent(const char* kind, const QString& title, const QString& name);
  void changeEvent(std::size_t mark,
                   const std::function<void(RecordingEvent&)>& change,
                   const QString& name);
  void removeEvent(std::size_t mark);
  bool saveEventsOf(const OpenedRecordingPtr& recording);
  bool hasUnsaved(const OpenedRecordingPtr& recording) const;
  // Asks once about labels that aren't saved; false: the user would rather go on. What is discarded is still
  // there: it goes with its recording.
  bool settleUnsaved(const std::vector<OpenedRecordingPtr>& recordings);
  void keepFoundGrasps(EventEditor& editor, std::optional<std::size_t> without);
  const std::vector<GraspSegment>& graspsOf(const OpenedRecordingPtr& recording);
  // main_window_session.cpp: where the user was
  void noteWhereWeAre();
  void goBackToWhereWeWere();
  void rememberSession();
  // main_window_filter.cpp: what is shown is seen through filters
  void buildFilter();
  void connectFilter(const std::optional<Recipe>& recipe);
  void filterNewSource();
  void showThroughFilter();
  void useShown(const OpenedRecordingPtr& recording);
  void takeKeptRecipe();
  void keepRecipe();
  void showLiveFilter();
  QString filterText() const;
  QString filteredCaption() const;
  std::ptrdiff_t saturatedNow() const;
  // main_window_library.cpp: Library and Log
  void buildLibrary();
  void placeLibrary();
  void connectLibrary();
  bool staysEverywhere(const Dock* dock) const;
  void showLibraryAgain();
  void rememberLibrary();
  void compareWith(const std::filesystem::path& path);
  // main_window_live.cpp: what is connected
  void connectLive();
  void askAndConnect();
  void tryEmulatedHand();
  void fillConnections();
  void liveCame();
  void liveLeaving();
  void liveEnded();
  void showLive();
  // Whose frames are shown: what is connected, or the same with other taxels scanned.
  void showHand(const HandDescription& hand);
  void showLook();
  void showStale();
  void setPictureOld(const OldPicture& old);  // of heat maps and hand
  void updateLiveStatus();
  // main_window_taxels.cpp
  void connectScanActions();
  void scan(MaskChoice choice);
  void heedScanAnswers();
  QString selectionText() const;
  // main_window_hand.cpp: the hand in space
  void connectHandView();
  void changeHand(const std::function<void(HandLook&)>& change);
  void showHandLook();
  void showViews(bool matrices, bool hand);
  ExportedView handExport();
  // main_window_compare.cpp
  void connectCompare();
  void showCompare(bool on);
  void seekCompared(double seconds);
  ExportedView compareExport();
  // main_window_recording.cpp
  void connectRecording();
  void useRecordingSettings();
  void toggleRecording();
  void markNow(const QString& label, std::optional<int> digit);
  void showRecordingState();
  void recordingEnded(const RecordingReport& report);
  void connectUnfinished();
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
  void setPlace(Place place);
  void placeDocks(Place place);
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
  OpenRecordings recordings_;
  AlarmBell bell_;
  LiveController live_;
  ActivityLog activity_;
  std::unique_ptr<TakeAway> takeAway_;
  BackgroundJob job_;     // asked for
  BackgroundJob finder_;  // of grasps in long recordings
  TaxelGroups groups_;
  PlottedExtras extras_;
  std::map<const OpenedRecording*, std::unique_ptr<EventEditor>> editors_;
  std::map<const OpenedRecording*, std::vector<GraspSegment>> grasps_;  // that were found

  std::filesystem::path demoPath_;
  bool loopIsOfDemo_ = false;  // not the user's choice: not remembered
  // Their files are being read anew, and their labels were discarded.
  std::set<const OpenedRecording*> discarded_;
  std::map<std::filesystem::path, LeftAt> leftAt_;
  OpenedRecordingPtr current_;
  OpenedRecordingPtr shown_;  // current_, or the same filtered
  FilterResults filterResults_;
  FilterWorker filterWorker_;
  Place place_ = Place::kStart;
  std::map<Place, QByteArray> layouts_;  // of docks
  QString hover_;
  QString flash_;
  QTimer flashTimer_;
  bool placed_ = false;   // setPlace() was called
  bool closing_ = false;  // as soon as nothing is connected any more
  bool liveShown_ = false;
  bool held_ = false;  // the live picture
  bool alarmIsNew_ = false;
  std::vector<std::shared_future<CommandAnswer>> scanAnswers_;
  RecordingSettings recordingSettings_;
  std::vector<std::filesystem::path> lastRecorded_;  // parts
  UnfinishedFinder unfinished_;
  std::vector<std::filesystem::path> recovered_;  // files of the recovery that runs
  bool recordingShown_ = false;                   // by the button
  Theme recordingTheme_ = Theme::kDark;
  const SignalHistory* shownHistory_ = nullptr;  // of the source that is shown; never looked into

  bool compareSeeks_ = false;                            // the playback follows, and isn't followed
  QByteArray layoutBeforeCompare_;                       // of docks
  QStackedWidget *stack_ = nullptr, *centre_ = nullptr;  // centre: matrices, or the comparison
  ComparePanel* compare_ = nullptr;
  MessageBanner* banner_ = nullptr;
  OpeningStrip *opening_ = nullptr, *exporting_ = nullptr, *working_ = nullptr;
  StartPage* startPage_ = nullptr;
  MatricesPanel* matrices_ = nullptr;
  HandPanel* handPanel_ = nullptr;
  QSplitter* views_ = nullptr;  // matrices and hand, side by side
  PlaybackBar* playbackBar_ = nullptr;
  TimelineHeader* timelineHeader_ = nullptr;
  QStackedWidget* charts_ = nullptr;
  TimelinePanel* timelinePanel_ = nullptr;
  TimelineChart* timeline_ = nullptr;  // of the panel
  SignalTree* signalTree_ = nullptr;
  LiveChart* liveChart_ = nullptr;
  InspectPanel* inspect_ = nullptr;
  HandDock* hand_ = nullptr;
  StatusStrip* status_ = nullptr;
  QList<Dock*> docks_;
  Dock *inspectDock_ = nullptr, *timelineDock_ = nullptr;
  Dock *handDock_ = nullptr, *linkDock_ = nullptr;
  LinkPanel* link_ = nullptr;
  FilterPanel* filter_ = nullptr;
  Dock* filterDock_ = nullptr;
  LibraryPanel* library_ = nullptr;
  Dock* libraryDock_ = nullptr;
  SpectrumPanel* spectrum_ = nullptr;
  Dock* spectrumDock_ = nullptr;
  class CalibrateView;  // main_window_calibrate.h
  CalibrateView* calibrate_ = nullptr;
  class SlipView;  // main_window_slip.h
  SlipView* slip_ = nullptr;
  LogPanel* log_ = nullptr;
  Dock* logDock_ = nullptr;
  MessageBanner* alarmStrip_ = nullptr;
  OfferStrip* offer_ = nullptr;
  class RecogniseView;  // main_window_recognise.h
  RecogniseView* recognise_ = nullptr;
  std::unique_ptr<WindowMenus> menus_;
};

}  // namespace palpate::gui

// The state that the features of the window share: the displayed source, the selection, messages,
// actions. Every feature is given this state, and none knows another feature.
#pragma once

#include <QSettings>
#include <QString>
#include <QStringList>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include <palpate/core/time.h>
#include <palpate/filter/recipe.h>

#include "gui/appearance/settings_file.h"
#include "gui/desktop/ask.h"
#include "gui/picture/exported_view.h"
#include "gui/source/live_controller.h"
#include "gui/source/open_recordings.h"
#include "gui/source/playback_controller.h"
#include "gui/source/recent_files.h"
#include "gui/source/recording_opener.h"
#include "gui/window_state/action_enabler.h"
#include "gui/window_state/action_registry.h"
#include "gui/window_state/active_filters.h"
#include "gui/window_state/activity_log.h"
#include "gui/window_state/comparison_mode.h"
#include "gui/window_state/current_frame.h"
#include "gui/window_state/derived_results.h"
#include "gui/window_state/displayed_source.h"
#include "gui/window_state/escape_handler.h"
#include "gui/window_state/event_controller.h"
#include "gui/window_state/formula_curves.h"
#include "gui/window_state/hand_commands.h"
#include "gui/window_state/menus.h"
#include "gui/window_state/messages.h"
#include "gui/window_state/selection.h"
#include "gui/window_state/user_prompts.h"
#include "gui/window_state/view_appearance.h"

namespace palpate::gui {

// What the window takes from its surroundings; tests supply their own.
struct WindowEnvironment {
  // Folder with the demo recording.
  std::filesystem::path dataFolder;
  // Path of the INI file of the settings.
  QString settingsPath;
  // Null: the system's clock.
  const Clock* clock = nullptr;
  // How a recording is read; empty: readRecording().
  RecordingOpener::Read read = {};
  // Joint angles assumed for recordings that have none [deg]; empty: none.
  std::vector<double> assumedAnglesDeg = {};
  // Recipe to switch on; nothing: that of the last session.
  std::optional<Recipe> recipe = {};
  // Whether the window, when it opens, offers to recover recordings that an earlier session left
  // unfinished.
  bool offerUnfinished = false;
  // Whether a grasp is played on the start page.
  bool playsOnStart = false;
  // Null: the user is asked by dialogues.
  Ask* ask = nullptr;
};

// The members are constructed in this order and destroyed in the reverse order.
struct WindowState {
  explicit WindowState(const WindowEnvironment& environment, QWidget* window);

  const WindowEnvironment environment;
  const SettingsPlace settingsPlace;
  QSettings settings;
  RecentFiles recent;
  ViewAppearance appearance;
  ActivityLog log;
  Messages messages;
  DialogAsk dialogs;
  Ask& ask;
  UserPrompts prompts;
  EscapeHandler escapeHandler;
  ActionRegistry actions;
  ActionEnabler actionEnabler;
  Menus menus;
  PlaybackController playback;
  RecordingOpener opener;
  OpenRecordings recordings;
  LiveController live;
  Selection selection;
  DisplayedSource displayed;
  EventController events;
  ActiveFilters activeFilters;
  CurrentFrame currentFrame;
  DerivedResults derivedResults;
  FormulaCurves formulas;
  ComparisonMode comparison;
  HandCommands handCommands;
  // The recordings chosen in the Library; may be empty: no Library.
  std::function<QStringList()> chosenRecordings;
  // Shows a folder in the Library (empty: the last one); may be empty: no Library.
  std::function<void(const QString& folder)> showLibrary;
  // Shows what the plan of recordings has left: "3 of 12 takes · next: ball, left, 2 of 3"; empty:
  // it is done, or there is none.
  std::function<void(const QString& left)> showPlanLeft;
  // Whether a batch runs; may be empty: none.
  std::function<bool()> batchRunning;

  // The recordings that were open before this run stay those that the next start opens, until one
  // is open in this run.
  bool keepsSession = false;

  std::filesystem::path demoRecording() const;

  // Opens the files in the background; messages about earlier files are withdrawn. Of folders the
  // last one is shown in the Library.
  void open(const std::vector<std::filesystem::path>& files,
            OpenRequest::Then then = OpenRequest::Then::kShowFirst);
  // Shows the recording of the first file and opens those that aren't open yet; an open one is not
  // read again.
  void openOrShow(const std::vector<std::filesystem::path>& files);
  // Asks the user for the files, then opens them.
  void askAndOpen(OpenRequest::Then then = OpenRequest::Then::kShowFirst);
  // Ends the previous connection first; never moves a hand.
  void connectTo(const Connection& connection);

  // The frames selected in the timeline; nothing: none.
  std::optional<FrameSpan> selectedFrames() const;
  // Names for exported files, without folder and extension: "ball", "ball_frame_00042",
  // "live_101502".
  QString recordingStem() const;
  QString frameStem() const;
  // The pictures of every frame of the displayed recording, without their painter; nothing: no
  // recording is shown.
  std::optional<FramePictures> framePictures(const QString& suffix) const;
  // Title above a picture and caption below it: what it shows, and of which time.
  QString pictureTitle() const;
  QString pictureCaption() const;
};

}  // namespace palpate::gui

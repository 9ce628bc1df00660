// What the parts of the window share: what is shown, chosen and said now. Features are given this,
// and never each other.
#pragma once

#include <QSettings>
#include <QString>
#include <filesystem>
#include <optional>
#include <vector>

#include <palpate/core/time.h>
#include <palpate/filter/recipe.h>

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
#include "gui/window_state/hand_commands.h"
#include "gui/window_state/menus.h"
#include "gui/window_state/messages.h"
#include "gui/window_state/selection.h"
#include "gui/window_state/user_prompts.h"
#include "gui/window_state/view_appearance.h"

namespace palpate::gui {

// What the window takes from outside; tests hand in their own.
struct WindowEnvironment {
  std::filesystem::path dataFolder;           // with the demo recording
  QString settingsPath;                       // INI file
  const Clock* clock = nullptr;               // null: the system's
  RecordingOpener::Read read = {};            // empty: openRecording
  std::vector<double> assumedAnglesDeg = {};  // of recordings without joint angles; empty: none
  std::optional<Recipe> recipe = {};          // switched on; nothing: what was there last
  bool offerUnfinished = false;  // recordings that an earlier day left, when the window opens
};

// Made in this order, and gone in the other one.
struct WindowState {
  explicit WindowState(const WindowEnvironment& environment, QWidget* window);

  const WindowEnvironment environment;
  QSettings settings;
  RecentFiles recent;
  ViewAppearance appearance;
  ActivityLog log;
  Messages messages;
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
  ComparisonMode comparison;
  HandCommands handCommands;

  std::filesystem::path demoRecording() const;

  // In the background; what was said of earlier files is withdrawn.
  void open(const std::vector<std::filesystem::path>& files,
            OpenRequest::Then then = OpenRequest::Then::kShowFirst);
  // Asks for them first.
  void askAndOpen(OpenRequest::Then then = OpenRequest::Then::kShowFirst);
  // Ends what is connected before; never moves a hand.
  void connectTo(const Connection& connection);

  // Frames that are selected in the timeline; nothing: none.
  std::optional<FrameSpan> selectedFrames() const;
  // Of files that are made of what is shown, without folder and ending: "ball", "ball_frame_00042",
  // "live_101502".
  QString recordingStem() const;
  QString frameStem() const;
  // Of every frame of the recording that is looked at, without their painter; nothing: none is.
  std::optional<FramePictures> framePictures(const QString& suffix) const;
  // What of, and when, over and below a picture.
  QString pictureTitle() const;
  QString pictureCaption() const;
};

}  // namespace palpate::gui

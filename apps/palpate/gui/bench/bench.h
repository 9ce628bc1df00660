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

#include "gui/bench/action_book.h"
#include "gui/bench/activity_log.h"
#include "gui/bench/comparing.h"
#include "gui/bench/enabling.h"
#include "gui/bench/escape.h"
#include "gui/bench/event_desk.h"
#include "gui/bench/filtering.h"
#include "gui/bench/hand_requests.h"
#include "gui/bench/menus.h"
#include "gui/bench/messages.h"
#include "gui/bench/moment.h"
#include "gui/bench/overlays.h"
#include "gui/bench/questions.h"
#include "gui/bench/selection.h"
#include "gui/bench/subject.h"
#include "gui/bench/view_look.h"
#include "gui/picture/exported_view.h"
#include "gui/source/live_controller.h"
#include "gui/source/open_recordings.h"
#include "gui/source/playback_controller.h"
#include "gui/source/recent_files.h"
#include "gui/source/recording_opener.h"

namespace palpate::gui {

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

// Made in this order, and gone in the other one.
struct Bench {
  explicit Bench(const WindowSurroundings& surroundings, QWidget* window);

  const WindowSurroundings surroundings;
  QSettings settings;
  RecentFiles recent;
  ViewLook look;
  ActivityLog log;
  Messages messages;
  Questions questions;
  Escape escape;
  ActionBook actions;
  Enabling enabling;
  Menus menus;
  PlaybackController playback;
  RecordingOpener opener;
  OpenRecordings recordings;
  LiveController live;
  Selection selection;
  Subject subject;
  EventDesk events;
  Filtering filtering;
  Moment moment;
  Overlays overlays;
  Comparing comparing;
  HandRequests handRequests;

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

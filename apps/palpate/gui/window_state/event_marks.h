// Makes the marks in the rows below the timeline: the grasps, gaps, labels, notes and other events
// of a recording, each a span of time with a name.
#pragma once

#include <QString>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <palpate/calibration/step_report.h>
#include <palpate/model/event.h>
#include <palpate/recognition/grasp_segments.h>

#include "gui/source/opened_recording.h"

namespace palpate {
struct SlipSeries;
}

namespace palpate::gui {

enum class EventLane { kGrasps, kSteps, kSlips, kGaps, kLabels, kNotes, kOthers };
inline constexpr std::array kAllEventLanes = {EventLane::kGrasps,
                                              EventLane::kSteps,
                                              EventLane::kSlips,
                                              EventLane::kGaps,
                                              EventLane::kLabels,
                                              EventLane::kNotes,
                                              EventLane::kOthers};
// "grasps", "gaps", ..
QString nameOf(EventLane lane);

// Kinds of events that the user makes.
inline constexpr const char* kLabelKind = "label";
inline constexpr const char* kNoteKind = "note";
// A grasp that the user has corrected.
inline constexpr const char* kSegmentKind = "segment";

inline constexpr const char* kGraspText = "grasp";

struct EventMark {
  EventLane lane = EventLane::kOthers;
  // [s] from the first frame.
  double fromS = 0.0;
  // [s] from the first frame; equal to fromS for a moment.
  double toS = 0.0;
  // Text on the bar.
  QString text;
  // Longer text for the tool tip.
  QString detail;
  // Index in the list of events; a grasp found automatically has none.
  std::optional<std::size_t> event;
  // Index in the list of grasps found automatically.
  std::optional<std::size_t> grasp;
  bool editable = false;
};

// The marks sorted by lane, then by time. Where the user has corrected grasps (segments), the
// grasps found automatically aren't shown.
std::vector<EventMark> marksOf(const OpenedRecording& recording,
                               std::span<const Event> events,
                               std::span<const GraspSegment> grasps);

// Inserts the loading steps found by the dock Calibrate into `marks`, in order.
void addSteps(const StepReport& report,
              const OpenedRecording& recording,
              std::vector<EventMark>& marks);

// Inserts the slip found by the dock Slip into `marks`, in order; matrices that slip at the same
// time share a bar.
void addSlips(const SlipSeries& series,
              const OpenedRecording& recording,
              std::vector<EventMark>& marks);

// Converts a grasp found automatically into an event.
Event segmentOf(const OpenedRecording& recording, const GraspSegment& grasp);

// An event that states that the recording has no grasp, so that none is searched for.
Event removedGraspEvent(const OpenedRecording& recording);
bool isRemovedGrasp(const Event& event);

// Converts seconds from the first frame into a time of the recording [us].
std::int64_t timeUsOf(const OpenedRecording& recording, double seconds);

}  // namespace palpate::gui

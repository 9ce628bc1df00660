// What the rows below the timeline show: the grasps, gaps, labels, notes and other events of a
// recording as spans of time with a name.
#pragma once

#include <QString>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <palpate/calibration/step_report.h>
#include <palpate/recognition/grasp_segments.h>
#include <palpate/recording/recording_event.h>

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
QString nameOf(EventLane lane);  // "grasps", ..

// Kinds of events that people make.
inline constexpr const char* kLabelKind = "label";
inline constexpr const char* kNoteKind = "note";
inline constexpr const char* kSegmentKind = "segment";  // a grasp that a person has corrected

inline constexpr const char* kGraspText = "grasp";

struct EventMark {
  EventLane lane = EventLane::kOthers;
  double fromS = 0.0;                // from the first frame
  double toS = 0.0;                  // fromS: a moment
  QString text;                      // on the bar
  QString detail;                    // more of it, for a tool tip
  std::optional<std::size_t> event;  // in the list of events; a grasp that was found has none
  std::optional<std::size_t> grasp;  // in the list of grasps that were found
  bool editable = false;
};

// By lane, then time. Where grasps have been corrected (segments), what was found isn't shown.
std::vector<EventMark> marksOf(const OpenedRecording& recording,
                               std::span<const RecordingEvent> events,
                               std::span<const GraspSegment> grasps);

// Loading steps that were found (dock Calibrate), among the others in their order.
void addSteps(const StepReport& report,
              const OpenedRecording& recording,
              std::vector<EventMark>& marks);

// Slip that was found (dock Slip), likewise: matrices that slip together share a bar.
void addSlips(const SlipSeries& series,
              const OpenedRecording& recording,
              std::vector<EventMark>& marks);

// A grasp that was found, as an event.
RecordingEvent segmentOf(const OpenedRecording& recording, const GraspSegment& grasp);

// Says that a recording has no grasp, whatever would be found.
RecordingEvent removedGraspEvent(const OpenedRecording& recording);
bool isRemovedGrasp(const RecordingEvent& event);

// Seconds from the first frame, as a time of the recording.
std::int64_t timeUsOf(const OpenedRecording& recording, double seconds);

}  // namespace palpate::gui

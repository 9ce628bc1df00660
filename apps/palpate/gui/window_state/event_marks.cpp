#include "gui/window_state/event_marks.h"

#include <QStringList>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

#include <palpate/core/error.h>
#include <palpate/core/json.h>
#include <palpate/core/number_text.h>
#include <palpate/core/time.h>
#include <palpate/recording/gap_events.h>
#include <palpate/slip/slip_series.h>

#include "gui/appearance/captions.h"

namespace palpate::gui {
namespace {

constexpr const char* kNoGraspText = "no grasp";

double eventMarksSecondsOf(const OpenedRecording& recording, std::int64_t us) {
  return static_cast<double>(us - timeUsOf(recording, 0.0)) / kUsPerS;
}

QString spanText(double fromS, double toS) {
  if (toS <= fromS) return "at " + figure(fromS, 2) + " s";
  return figure(fromS, 2) + " – " + figure(toS, 2) + " s (" + figure(toS - fromS, 2) + " s)";
}

QString fingersText(const std::vector<int>& fingers) {
  QStringList words;
  for (const int finger : fingers) words.append(QString::number(finger));
  return "fingers " + words.join(", ");
}

QString keyWords(const std::string& key) { return QString::fromStdString(key).replace('_', ' '); }

// A value of the details of an event in words; those of an object are joined by commas.
QString detailWords(const Json& value) {
  if (value.isBool()) return value.asBool() ? "yes" : "no";
  if (value.isNull()) return "not known";
  if (value.isString()) return QString::fromStdString(value.asString());
  if (value.isNumber()) return QString::fromStdString(numberText(value.asDouble()));
  QStringList parts;
  if (value.isObject())
    for (const std::string& key : value.keys())
      parts.append(keyWords(key) + " " + detailWords(value.at(key)));
  for (std::size_t i = 0; value.isArray() && i < value.size(); ++i)
    parts.append(detailWords(value.at(i)));
  return parts.join(value.isArray() ? "; " : ", ");
}

// The details of an event in words, a line for each of its members; empty: it has none, or none
// that can be read.
QString detailsText(const std::string& json) {
  constexpr qsizetype kMaxLetters = 400;
  if (json.empty()) return {};
  QStringList lines;
  try {
    const Json details = Json::parse(json);
    for (const std::string& key : details.keys())
      lines.append(keyWords(key) + ": " + detailWords(details.at(key)));
  } catch (const Error&) {
    return {};
  }
  const QString text = lines.join("\n");
  return text.size() > kMaxLetters ? text.left(kMaxLetters) + "…" : text;
}

EventLane laneOf(const std::string& kind) {
  if (kind == kSegmentKind) return EventLane::kGrasps;
  if (kind == kLabelKind || kind == "mark") return EventLane::kLabels;
  if (kind == kNoteKind) return EventLane::kNotes;
  // Slip detected while recording.
  if (kind == "slip") return EventLane::kSlips;
  return kind == "gap" ? EventLane::kGaps : EventLane::kOthers;
}

EventMark markOf(const OpenedRecording& recording, const Event& event, std::size_t index) {
  EventMark mark;
  mark.lane = laneOf(event.kind);
  mark.fromS = eventMarksSecondsOf(recording, event.tUs);
  mark.toS = std::max(mark.fromS, eventMarksSecondsOf(recording, event.t1Us));
  mark.text = QString::fromStdString(event.text.empty() ? event.kind : event.text);
  mark.event = index;
  mark.editable = mark.lane == EventLane::kGrasps || mark.lane == EventLane::kLabels ||
                  mark.lane == EventLane::kNotes;
  mark.detail =
      QString::fromStdString(event.kind) + ": " + mark.text + "\n" + spanText(mark.fromS, mark.toS);
  // The text of a gap says all that its details hold.
  if (!mark.editable && mark.lane != EventLane::kGaps)
    if (const QString details = detailsText(event.json); !details.isEmpty())
      mark.detail += "\n" + details;
  return mark;
}

bool touchesAnyGap(const OpenedRecording& recording, const Event& event) {
  const std::vector<Gap>& gaps = recording.timingNow().gaps;
  return std::any_of(gaps.begin(), gaps.end(), [&](const Gap& gap) {
    return touchesGap(event, gap, recording.profile);
  });
}

void addGaps(const OpenedRecording& recording, std::vector<EventMark>& marks) {
  for (const Gap& gap : recording.timingNow().gaps) {
    EventMark mark;
    mark.lane = EventLane::kGaps;
    mark.fromS = recording.timeAt(gap.frame);
    mark.toS = mark.fromS + gap.seconds;
    mark.text = figure(gap.seconds, 1) + " s";
    mark.detail = "gap: " + recording.reasonOf(gap) + "\n" + spanText(mark.fromS, mark.toS);
    marks.push_back(std::move(mark));
  }
}

void addGrasps(const OpenedRecording& recording,
               std::span<const GraspSegment> grasps,
               std::vector<EventMark>& marks) {
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    const GraspSegment& grasp = grasps[i];
    EventMark mark;
    mark.lane = EventLane::kGrasps;
    mark.fromS = recording.timeAt(grasp.begin);
    mark.toS = recording.timeAt(grasp.end);
    mark.text = QString::number(i + 1);
    mark.detail = "grasp " + mark.text + " (found)\n" + spanText(mark.fromS, mark.toS) +
                  "\nframes " + QString::number(grasp.begin) + " – " + QString::number(grasp.end) +
                  "\n" + fingersText(grasp.fingers) + ", quality " + figure(grasp.quality, 2);
    mark.grasp = i;
    mark.editable = true;
    marks.push_back(std::move(mark));
  }
}

void sortMarks(std::vector<EventMark>& marks) {
  std::stable_sort(marks.begin(), marks.end(), [](const EventMark& a, const EventMark& b) {
    return std::tuple(a.lane, a.fromS) < std::tuple(b.lane, b.fromS);
  });
}

}  // namespace

QString nameOf(EventLane lane) {
  switch (lane) {
    case EventLane::kGrasps:
      return "grasps";
    case EventLane::kSteps:
      return "steps";
    case EventLane::kSlips:
      return "slip";
    case EventLane::kGaps:
      return "gaps";
    case EventLane::kLabels:
      return "labels";
    case EventLane::kNotes:
      return "notes";
    case EventLane::kOthers:
      break;
  }
  return "events";
}

std::int64_t timeUsOf(const OpenedRecording& recording, double seconds) {
  const Profile& profile = recording.profile;
  const std::int64_t origin = profile.numFrames() > 0         ? profile.frameTimeUs(0)
                              : profile.numAngles() > 0       ? profile.angleTimeUs(0)
                              : profile.numTemperatures() > 0 ? profile.temperatureTimeUs(0)
                                                              : 0;
  return origin + std::llround(seconds * kUsPerS);
}

Event segmentOf(const OpenedRecording& recording, const GraspSegment& grasp) {
  Event event;
  event.kind = kSegmentKind;
  event.tUs = recording.profile.frameTimeUs(grasp.begin);
  event.t1Us = recording.profile.frameTimeUs(grasp.end);
  event.text = kGraspText;
  Json fingers = Json::array();
  for (const int finger : grasp.fingers) fingers.push(finger);
  event.json = Json::object().set("fingers", fingers).set("quality", grasp.quality).text(-1);
  return event;
}

Event removedGraspEvent(const OpenedRecording& recording) {
  Event event;
  event.kind = kSegmentKind;
  event.tUs = event.t1Us = timeUsOf(recording, 0.0);
  event.text = kNoGraspText;
  return event;
}

bool isRemovedGrasp(const Event& event) {
  return event.kind == kSegmentKind && event.text == kNoGraspText && event.t1Us == event.tUs;
}

void addSteps(const StepReport& report,
              const OpenedRecording& recording,
              std::vector<EventMark>& marks) {
  for (std::size_t i = 0; i < report.steps.size(); ++i) {
    const FittedStep& found = report.steps[i];
    EventMark mark;
    mark.lane = EventLane::kSteps;
    mark.fromS = recording.timeAt(found.step.begin);
    mark.toS = recording.timeAt(found.step.end);
    mark.text = QString::number(i + 1);
    mark.detail = "loading step " + mark.text + " of " +
                  QString::fromStdString(recording.profile.hand().matrixName(report.matrix)) +
                  " (found)\n" + spanText(mark.fromS, mark.toS);
    if (found.fit.converged)
      mark.detail += "\nK " + figure(found.fit.parameters.staticResponseCounts, 1) + " counts" +
                     (found.usable() ? "" : ", not used for calibration");
    marks.push_back(std::move(mark));
  }
  sortMarks(marks);
}

void addSlips(const SlipSeries& series,
              const OpenedRecording& recording,
              std::vector<EventMark>& marks) {
  const HandDescription& hand = recording.profile.hand();
  EventMark* last = nullptr;
  QStringList names;
  std::vector<EventMark> bars;
  bars.reserve(series.slips.size());
  for (const SlipSegment& slip : series.slips) {
    const double fromS = recording.timeAt(slip.begin), toS = recording.timeAt(slip.end);
    // Matrices that slip at the same time share one bar.
    if (last == nullptr || fromS > last->toS) {
      last = &bars.emplace_back();
      last->lane = EventLane::kSlips;
      last->fromS = fromS;
      names.clear();
    } else {
      last->detail += "\n";
    }
    last->toS = std::max(last->toS, toS);
    const QString name = QString::fromStdString(hand.matrices.at(slip.matrix).shortName);
    if (!names.contains(name)) names.append(name);
    last->text = names.join(", ");
    last->detail += "slip of " + QString::fromStdString(hand.matrixName(slip.matrix)) +
                    " (found)\n" + spanText(fromS, toS) + "\npath " + figure(slip.pathTaxels, 2) +
                    " taxels, turned " + figure(slip.rotationDeg, 1) + "°, confidence " +
                    figure(slip.confidence, 2);
  }
  std::move(bars.begin(), bars.end(), std::back_inserter(marks));
  sortMarks(marks);
}

std::vector<EventMark> marksOf(const OpenedRecording& recording,
                               std::span<const Event> events,
                               std::span<const GraspSegment> grasps) {
  std::vector<EventMark> marks;
  for (std::size_t i = 0; i < events.size(); ++i)
    // Gaps of frames are exact from the time stamps and tell what the recorder wrote about them. A
    // gap of angles or temperatures, and what was lost behind the last frame, is known from its
    // event alone.
    if (!isRemovedGrasp(events[i]) &&
        (events[i].kind != "gap" ||
         (!events[i].text.empty() && !touchesAnyGap(recording, events[i]))))
      marks.push_back(markOf(recording, events[i], i));
  const bool corrected = std::any_of(
      events.begin(), events.end(), [](const auto& event) { return event.kind == kSegmentKind; });
  if (!corrected) addGrasps(recording, grasps, marks);
  addGaps(recording, marks);
  sortMarks(marks);
  std::size_t number = 0;
  for (EventMark& mark : marks) {
    if (mark.lane != EventLane::kGrasps) continue;
    ++number;
    if (mark.text == kGraspText) mark.text = QString::number(number);
  }
  return marks;
}

}  // namespace palpate::gui

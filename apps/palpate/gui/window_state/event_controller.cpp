#include "gui/window_state/event_controller.h"

#include <QStringList>
#include <algorithm>

#include <palpate/core/error.h>
#include <palpate/recording/event_store.h>

namespace palpate::gui {
namespace {

// Topic of the failure to save the events of a recording.
QString unsavedTopic(const OpenedRecording& recording) {
  return "events not saved: " + QString::fromStdString(recording.path.string());
}

}  // namespace

EventController::EventController(DisplayedSource& displayed,
                                 OpenRecordings& recordings,
                                 Messages& messages,
                                 Ask& ask,
                                 QObject* parent)
    : QObject(parent),
      displayed_(displayed),
      recordings_(recordings),
      messages_(messages),
      ask_(ask) {
  connect(&displayed_, &DisplayedSource::shown, this, &EventController::renewMarks);
  connect(&displayed_, &DisplayedSource::moreKnown, this, &EventController::renewMarks);
  connect(&recordings_, &OpenRecordings::gone, this, &EventController::forget);
  connect(&recordings_, &OpenRecordings::settled, this, [this] { discarded_.clear(); });
  recordings_.mayReadAnew = [this](const OpenedRecordingPtr& recording) {
    if (!settle({recording})) return false;
    if (hasUnsaved(recording)) discarded_.insert(recording.get());
    return true;
  };
  recordings_.mayReplace = [this](const OpenedRecordingPtr& recording) {
    if (!hasUnsaved(recording) || discarded_.contains(recording.get())) return true;
    messages_.flash(fileNameOf(*recording) + " wasn't replaced: save or discard its changes first");
    return false;
  };
}

void EventController::forget(const OpenedRecordingPtr& recording) {
  editors_.erase(recording.get());
  grasps_.erase(recording.get());
  discarded_.erase(recording.get());
  messages_.withdraw(unsavedTopic(*recording));
}

EventEditor* EventController::editor() {
  const OpenedRecordingPtr recording = displayed_.recorded();
  if (!recording) return nullptr;
  auto& editor = editors_[recording.get()];
  if (!editor) {
    editor = std::make_unique<EventEditor>(
        recording->events,
        [path = recording->path, notInFile = recording->notInFile](const EventsReport& asRead,
                                                                   const std::vector<Event>& now) {
          palpate::saveEvents(path,
                              {withoutEvents(asRead.events, notInFile), asRead.damaged},
                              withoutEvents(now, notInFile));
        });
    connect(editor.get(), &EventEditor::changed, this, &EventController::renewMarks);
    connect(editor.get(),
            &EventEditor::changed,
            this,
            [this, now = editor.get(), topic = unsavedTopic(*recording)] {
              if (!now->unsaved()) messages_.withdraw(topic);
            });
  }
  return editor.get();
}

const std::vector<GraspSegment>& EventController::graspsOf(const OpenedRecordingPtr& recording) {
  const auto known = grasps_.find(recording.get());
  if (known != grasps_.end()) return known->second;
  auto& found = grasps_[recording.get()];
  // Without the gaps that only the events tell of: the commands, the comparison and the export of
  // each grasp number the same grasps.
  if (!recording->isLong())
    return found = findGrasps(recording->profile, recording->table, timingOf(recording->profile));
  // The recording may last hours: its grasps are found in the background.
  auto result = std::make_shared<std::vector<GraspSegment>>();
  finder_.start(
      {},
      [result, recording](const Progress& progress) {
        *result = findGrasps(recording->profile, {}, progress);
      },
      [this, result, recording] {
        // The recording was closed meanwhile.
        if (!grasps_.contains(recording.get())) return;
        grasps_[recording.get()] = std::move(*result);
        renewMarks();
      });
  return found;
}

std::vector<Event> EventController::eventsOf(const OpenedRecordingPtr& recording) const {
  const auto editor = editors_.find(recording.get());
  return editor == editors_.end() ? recording->events.events : editor->second->events();
}

void EventController::renewMarks() {
  marks_.clear();
  if (const EventEditor* now = editor()) {
    const OpenedRecordingPtr recording = displayed_.recorded();
    marks_ = marksOf(*recording, now->events(), graspsOf(recording));
    for (const Found& found : found_) found(recording, marks_);
  }
  emit changed();
}

void EventController::add(const Event& event, const QString& name) {
  if (EventEditor* now = editor()) now->add(event, name);
}

void EventController::addGrasp(const Event& segment) {
  EventEditor* now = editor();
  if (!now) return;
  now->changeTogether("a grasp", [&] {
    keepFoundGrasps(*now, std::nullopt);
    now->add(segment, "a grasp");
  });
}

// Turns all grasps found automatically into events of the user, except `without`, which the caller
// changes or removes.
void EventController::keepFoundGrasps(EventEditor& editor, std::optional<std::size_t> without) {
  const auto isSegment = [](const Event& event) { return event.kind == kSegmentKind; };
  const auto& now = editor.events();
  for (std::size_t i = 0; i < now.size(); ++i)
    if (isRemovedGrasp(now[i])) return editor.remove(i, "grasps");
  if (std::any_of(now.begin(), now.end(), isSegment)) return;
  const OpenedRecordingPtr recording = displayed_.recorded();
  const std::vector<GraspSegment>& found = graspsOf(recording);
  for (std::size_t i = 0; i < found.size(); ++i)
    if (i != without) editor.add(segmentOf(*recording, found[i]), "grasps");
}

void EventController::change(std::size_t index,
                             const std::function<void(Event&)>& change,
                             const QString& name) {
  EventEditor* now = editor();
  const EventMark mark = marks_.at(index);
  if (!now || !mark.editable) return;
  if (mark.event) {
    Event changed = now->events().at(*mark.event);
    change(changed);
    return now->change(*mark.event, changed, name);
  }
  const OpenedRecordingPtr recording = displayed_.recorded();
  Event changed = segmentOf(*recording, graspsOf(recording).at(*mark.grasp));
  change(changed);
  now->changeTogether(name, [&] {
    keepFoundGrasps(*now, mark.grasp);
    now->add(changed, name);
  });
}

void EventController::remove(std::size_t index) {
  EventEditor* now = editor();
  const EventMark mark = marks_.at(index);
  if (!now || !mark.editable) return;
  const QString name = mark.lane == EventLane::kGrasps ? "deleting a grasp" : "deleting an event";
  now->changeTogether(name, [&] {
    if (mark.event)
      now->remove(*mark.event, name);
    else
      keepFoundGrasps(*now, mark.grasp);
    const auto& left = now->events();
    const bool none = std::none_of(
        left.begin(), left.end(), [](const Event& event) { return event.kind == kSegmentKind; });
    // Without this event the grasps found automatically would be shown again.
    if (mark.lane == EventLane::kGrasps && none)
      now->add(removedGraspEvent(*displayed_.recorded()), name);
  });
}

void EventController::keep(const std::string& kind,
                           const std::optional<Event>& event,
                           const QString& name) {
  EventEditor* now = editor();
  if (!now) return;
  now->changeTogether(name, [&] {
    for (std::size_t i = now->events().size(); i-- > 0;)
      if (now->events()[i].kind == kind) now->remove(i, name);
    if (event) now->add(*event, name);
  });
}

bool EventController::hasUnsaved(const OpenedRecordingPtr& recording) const {
  const auto editor = editors_.find(recording.get());
  return editor != editors_.end() && editor->second && editor->second->unsaved();
}

bool EventController::save(const OpenedRecordingPtr& recording) {
  if (!hasUnsaved(recording)) return true;
  try {
    editors_.at(recording.get())->save();
    return true;
  } catch (const std::exception& error) {
    messages_.failAbout(
        unsavedTopic(*recording),
        "Labels, notes and grasps were not saved: " + QString::fromUtf8(error.what()) +
            "; File > Save as… saves the recording with them under another name");
    return false;
  }
}

void EventController::savedElsewhere(const OpenedRecordingPtr& recording) {
  messages_.withdraw(unsavedTopic(*recording));
}

bool EventController::settle(const std::vector<OpenedRecordingPtr>& recordings, bool asks) {
  std::vector<OpenedRecordingPtr> unsaved;
  QStringList names;
  for (const OpenedRecordingPtr& recording : recordings) {
    if (!hasUnsaved(recording)) continue;
    unsaved.push_back(recording);
    names.append(fileNameOf(*recording));
  }
  if (unsaved.empty()) return true;
  if (asks) {
    const int answer =
        ask_.choice("Labels, notes or grasps were changed and not saved:\n" + names.join("\n"),
                    {"Save", "Discard"},
                    0);
    if (answer != 0) return answer == 1;
  }
  bool saved = true;
  for (const OpenedRecordingPtr& recording : unsaved) saved = save(recording) && saved;
  return saved;
}

}  // namespace palpate::gui

// Holds the events of the open recordings (grasps, labels and notes, as edited, and the grasps
// found automatically) and the marks made of them, which the rows below the timeline show. Asks the
// user before unsaved events would be lost.
#pragma once

#include <QObject>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <palpate/model/event.h>
#include <palpate/recognition/grasp_segments.h>

#include "gui/desktop/ask.h"
#include "gui/source/background_job.h"
#include "gui/source/event_editor.h"
#include "gui/source/open_recordings.h"
#include "gui/window_state/displayed_source.h"
#include "gui/window_state/event_marks.h"
#include "gui/window_state/messages.h"

namespace palpate::gui {

class EventController : public QObject {
  Q_OBJECT
 public:
  // All arguments must outlive this object.
  EventController(DisplayedSource& displayed,
                  OpenRecordings& recordings,
                  Messages& messages,
                  Ask& ask,
                  QObject* parent = nullptr);

  // Editor of the events of the displayed recording; null: no recording is shown.
  EventEditor* editor();
  // The grasps found in the recording. Those of a long recording are found in the background; then
  // the result is empty at first and changed() follows.
  const std::vector<GraspSegment>& graspsOf(const OpenedRecordingPtr& recording);
  // The marks of the displayed recording.
  const std::vector<EventMark>& marks() const noexcept { return marks_; }
  // Lets other features add marks of what they found; called whenever the marks are rebuilt. What
  // the function refers to must outlive this object, or forgetFound() must be called first.
  using Found = std::function<void(const OpenedRecordingPtr&, std::vector<EventMark>&)>;
  void addFound(Found found) { found_.push_back(std::move(found)); }
  void forgetFound() { found_.clear(); }
  void renewMarks();

  // The events of an open recording as they are now, saved or not.
  std::vector<Event> eventsOf(const OpenedRecordingPtr& recording) const;

  void add(const Event& event, const QString& name);
  // Adds a grasp marked by the user. All grasps found automatically become events of the user, too.
  void addGrasp(const Event& segment);
  // Changes the event behind a mark; a mark that can't be edited is left as it is.
  void change(std::size_t mark, const std::function<void(Event&)>& change, const QString& name);
  void remove(std::size_t mark);
  // Replaces all events of this kind by `event`; with nothing, only removes them.
  void keep(const std::string& kind, const std::optional<Event>& event, const QString& name);

  bool hasUnsaved(const OpenedRecordingPtr& recording) const;
  // Returns false when saving failed; the failure is shown to the user, until nothing is unsaved
  // any more, the events are saved elsewhere or the recording is closed.
  bool save(const OpenedRecordingPtr& recording);
  // The events of the recording were saved in another file: a shown failure has been dealt with.
  void savedElsewhere(const OpenedRecordingPtr& recording);
  // Asks the user once about all unsaved events, or saves them unasked; returns false when the user
  // cancels or saving fails. Discarded events stay in the editor until their recording is closed,
  // or until discardAll().
  bool settle(const std::vector<OpenedRecordingPtr>& recordings, bool asks = true);
  void discardAll() { editors_.clear(); }

 signals:
  // marks() or the events in the editor have changed.
  void changed();

 private:
  void keepFoundGrasps(EventEditor& editor, std::optional<std::size_t> without);
  void forget(const OpenedRecordingPtr& recording);

  DisplayedSource& displayed_;
  OpenRecordings& recordings_;
  Messages& messages_;
  Ask& ask_;
  // Finds the grasps of long recordings.
  BackgroundJob finder_{BackgroundJob::Leaving::kAtOnce};
  std::map<const OpenedRecording*, std::unique_ptr<EventEditor>> editors_;
  // The grasps that were found.
  std::map<const OpenedRecording*, std::vector<GraspSegment>> grasps_;
  // Recordings whose files are being read again and whose unsaved events the user discarded.
  std::set<const OpenedRecording*> discarded_;
  std::vector<Found> found_;
  std::vector<EventMark> marks_;
};

}  // namespace palpate::gui

// The events of the recordings that are open: grasps, labels and notes as they are edited, and what
// was found, as the marks that stand below the timeline. The user is asked before anything that is
// not saved would be lost.
#pragma once

#include <QObject>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <palpate/recognition/grasp_segments.h>
#include <palpate/recording/recording_event.h>

#include "gui/source/background_job.h"
#include "gui/source/event_editor.h"
#include "gui/source/open_recordings.h"
#include "gui/window_state/displayed_source.h"
#include "gui/window_state/event_marks.h"
#include "gui/window_state/messages.h"
#include "gui/window_state/user_prompts.h"

namespace palpate::gui {

class EventController : public QObject {
  Q_OBJECT
 public:
  // All of them must outlive it.
  EventController(DisplayedSource& displayed,
                  OpenRecordings& recordings,
                  Messages& messages,
                  const UserPrompts& prompts,
                  QObject* parent = nullptr);

  // Of the recording that is looked at; null: none is.
  EventEditor* editor();
  // As the events say, or as found; of a long recording they are found beside the window, and
  // changed() follows.
  const std::vector<GraspSegment>& graspsOf(const OpenedRecordingPtr& recording);
  // Of the recording that is looked at.
  const std::vector<EventMark>& marks() const noexcept { return marks_; }
  // What others found, among the marks: called whenever they are made anew. It must outlive this,
  // or be forgotten.
  using Found = std::function<void(const OpenedRecordingPtr&, std::vector<EventMark>&)>;
  void addFound(Found found) { found_.push_back(std::move(found)); }
  void forgetFound() { found_.clear(); }
  void renewMarks();

  void add(const RecordingEvent& event, const QString& name);
  // A grasp that a person says is there: from then on what was found is what people say, too.
  void addGrasp(const RecordingEvent& segment);
  // Of a mark that can be edited; others are left as they are.
  void change(std::size_t mark,
              const std::function<void(RecordingEvent&)>& change,
              const QString& name);
  void remove(std::size_t mark);
  // Instead of the events of its kind that are there; nothing: only takes these away.
  void keep(const std::string& kind,
            const std::optional<RecordingEvent>& event,
            const QString& name);

  bool hasUnsaved(const OpenedRecordingPtr& recording) const;
  // False: it couldn't be saved, and was said.
  bool save(const OpenedRecordingPtr& recording);
  // Asks once about what isn't saved; false: the user would rather go on. What is discarded is
  // still there: it goes with its recording, or by discardAll().
  bool settle(const std::vector<OpenedRecordingPtr>& recordings);
  void discardAll() { editors_.clear(); }

 signals:
  void changed();  // marks(), or what the editor holds

 private:
  void keepFoundGrasps(EventEditor& editor, std::optional<std::size_t> without);
  void forget(const OpenedRecordingPtr& recording);

  DisplayedSource& displayed_;
  OpenRecordings& recordings_;
  Messages& messages_;
  const UserPrompts& prompts_;
  BackgroundJob finder_;  // of grasps in long recordings
  std::map<const OpenedRecording*, std::unique_ptr<EventEditor>> editors_;
  std::map<const OpenedRecording*, std::vector<GraspSegment>> grasps_;  // that were found
  // Their files are being read anew, and their labels were discarded.
  std::set<const OpenedRecording*> discarded_;
  std::vector<Found> found_;
  std::vector<EventMark> marks_;
};

}  // namespace palpate::gui

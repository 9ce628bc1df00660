// The events of a recording while a person edits them: every change can be undone, until it is
// saved and after.
#pragma once

#include <QObject>
#include <QUndoStack>
#include <functional>
#include <optional>
#include <vector>

#include <palpate/recording/recording_event.h>

namespace palpate::gui {

class EventEditor : public QObject {
  Q_OBJECT
 public:
  // Stores the events in the file; throws palpate::Error where it can't.
  using Save =
      std::function<void(const EventsReport& asRead, const std::vector<RecordingEvent>& now)>;

  EventEditor(EventsReport asRead, Save save, QObject* parent = nullptr);

  ~EventEditor() override;

  const std::vector<RecordingEvent>& events() const noexcept { return events_; }  // by time
  // `name` is what the undo menu calls it. Throw std::out_of_range for an event that isn't there.
  void add(const RecordingEvent& event, const QString& name);
  void change(std::size_t index, const RecordingEvent& to, const QString& name);
  void remove(std::size_t index, const QString& name);
  // Several changes that are undone together.
  void changeTogether(const QString& name, const std::function<void()>& changes);

  QUndoStack& undoStack() noexcept { return undo_; }
  bool unsaved() const { return !undo_.isClean(); }
  // Throws palpate::Error: nothing was stored, the changes are still here.
  void save();

 signals:
  void changed();

 private:
  class Change;
  void push(std::optional<RecordingEvent> before,
            std::optional<RecordingEvent> after,
            const QString& name);
  void apply(const std::optional<RecordingEvent>& out, const std::optional<RecordingEvent>& in);

  EventsReport asRead_;
  std::vector<RecordingEvent> events_;
  Save save_;
  QUndoStack undo_;
};

}  // namespace palpate::gui

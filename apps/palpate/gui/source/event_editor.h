// Edits the events of one recording, with undo: every change can be undone, before it is saved and
// after.
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
  // Stores the events in the file; throws palpate::Error when that fails.
  using Save =
      std::function<void(const EventsReport& asRead, const std::vector<RecordingEvent>& now)>;

  EventEditor(EventsReport asRead, Save save, QObject* parent = nullptr);

  ~EventEditor() override;

  // The events, sorted by time.
  const std::vector<RecordingEvent>& events() const noexcept { return events_; }
  // `name` names the change in the menu Edit. change() and remove() throw std::out_of_range for an
  // event that doesn't exist.
  void add(const RecordingEvent& event, const QString& name);
  // Several at once, which are undone together.
  void add(std::vector<RecordingEvent> events, const QString& name);
  void change(std::size_t index, const RecordingEvent& to, const QString& name);
  void remove(std::size_t index, const QString& name);
  // Groups several changes, so that they are undone together.
  void changeTogether(const QString& name, const std::function<void()>& changes);

  QUndoStack& undoStack() noexcept { return undo_; }
  bool unsaved() const { return !undo_.isClean(); }
  // Throws palpate::Error when nothing could be stored; the changes are kept.
  void save();

 signals:
  void changed();

 private:
  class Change;
  class Addition;
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

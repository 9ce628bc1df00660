// Edits the events of one recording, with undo: every change can be undone, before it is saved and
// after.
#pragma once

#include <QObject>
#include <QUndoStack>
#include <functional>
#include <optional>
#include <vector>

#include <palpate/model/event.h>

namespace palpate::gui {

class EventEditor : public QObject {
  Q_OBJECT
 public:
  // Stores the events in the file; throws palpate::Error when that fails.
  using Save = std::function<void(const EventsReport& asRead, const std::vector<Event>& now)>;

  EventEditor(EventsReport asRead, Save save, QObject* parent = nullptr);

  ~EventEditor() override;

  // The events, sorted by time.
  const std::vector<Event>& events() const noexcept { return events_; }
  // `name` names the change in the menu Edit. change() and remove() throw std::out_of_range for an
  // event that doesn't exist.
  void add(const Event& event, const QString& name);
  // Several at once, which are undone together.
  void add(std::vector<Event> events, const QString& name);
  void change(std::size_t index, const Event& to, const QString& name);
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
  void push(std::optional<Event> before, std::optional<Event> after, const QString& name);
  void apply(const std::optional<Event>& out, const std::optional<Event>& in);

  EventsReport asRead_;
  std::vector<Event> events_;
  Save save_;
  QUndoStack undo_;
};

}  // namespace palpate::gui

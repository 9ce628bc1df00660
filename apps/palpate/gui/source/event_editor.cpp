#include "gui/source/event_editor.h"

#include <algorithm>
#include <iterator>

namespace palpate::gui {

// Undo command that changes, adds or removes one event.
class EventEditor::Change : public QUndoCommand {
 public:
  Change(EventEditor& editor,
         std::optional<Event> before,
         std::optional<Event> after,
         const QString& name)
      : QUndoCommand(name), editor_(editor), before_(std::move(before)), after_(std::move(after)) {}
  void undo() override { editor_.apply(after_, before_); }
  void redo() override { editor_.apply(before_, after_); }

 private:
  EventEditor& editor_;
  std::optional<Event> before_;
  std::optional<Event> after_;
};

// Undo command that adds any number of events: one after the other, each would move all others.
class EventEditor::Addition : public QUndoCommand {
 public:
  Addition(EventEditor& editor, std::vector<Event> added, const QString& name)
      : QUndoCommand(name), editor_(editor), before_(editor.events_), after_(editor.events_) {
    after_.insert(
        after_.end(), std::make_move_iterator(added.begin()), std::make_move_iterator(added.end()));
    std::stable_sort(
        after_.begin(), after_.end(), [](const Event& a, const Event& b) { return a.tUs < b.tUs; });
  }
  void undo() override { editor_.events_ = before_; }
  void redo() override { editor_.events_ = after_; }

 private:
  EventEditor& editor_;
  std::vector<Event> before_;
  std::vector<Event> after_;
};

EventEditor::EventEditor(EventsReport asRead, Save save, QObject* parent)
    : QObject(parent), asRead_(std::move(asRead)), events_(asRead_.events), save_(std::move(save)) {
  connect(&undo_, &QUndoStack::cleanChanged, this, &EventEditor::changed);
  // Changes that are undone or redone together emit changed() once.
  connect(&undo_, &QUndoStack::indexChanged, this, &EventEditor::changed);
}

// The undo stack changes its index while it is destroyed; that must not emit changed().
EventEditor::~EventEditor() { undo_.disconnect(this); }

void EventEditor::apply(const std::optional<Event>& out, const std::optional<Event>& in) {
  if (out) {
    const auto at = std::find(events_.begin(), events_.end(), *out);
    if (at != events_.end()) {
      // Among events of the same time it keeps its place.
      if (in && in->tUs == out->tUs) {
        *at = *in;
        return;
      }
      events_.erase(at);
    }
  }
  if (in) {
    const auto at =
        std::upper_bound(events_.begin(), events_.end(), *in, [](const Event& a, const Event& b) {
          return a.tUs < b.tUs;
        });
    events_.insert(at, *in);
  }
}

void EventEditor::push(std::optional<Event> before,
                       std::optional<Event> after,
                       const QString& name) {
  if (before == after) return;
  undo_.push(new Change(*this, std::move(before), std::move(after), name));
}

void EventEditor::add(const Event& event, const QString& name) { push(std::nullopt, event, name); }

void EventEditor::add(std::vector<Event> events, const QString& name) {
  if (!events.empty()) undo_.push(new Addition(*this, std::move(events), name));
}

void EventEditor::change(std::size_t index, const Event& to, const QString& name) {
  push(events_.at(index), to, name);
}

void EventEditor::remove(std::size_t index, const QString& name) {
  push(events_.at(index), std::nullopt, name);
}

void EventEditor::changeTogether(const QString& name, const std::function<void()>& changes) {
  undo_.beginMacro(name);
  changes();
  undo_.endMacro();
}

void EventEditor::save() {
  save_(asRead_, events_);
  asRead_.events = events_;
  undo_.setClean();
}

}  // namespace palpate::gui

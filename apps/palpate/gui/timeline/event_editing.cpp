#include "gui/timeline/event_editing.h"

#include <QMenu>
#include <QUndoStack>
#include <algorithm>

#include "gui/appearance/captions.h"
#include "gui/timeline/event_rows.h"

namespace palpate::gui {

EventEditing::EventEditing(WindowState& windowState,
                           const TimelineActions& actions,
                           EventRows& rows)
    : windowState_(windowState), actions_(actions), rows_(rows) {
  connectActions();
  connectRows();
  addConditions();
}

void EventEditing::connectActions() {
  const TimelineActions& actions = actions_;
  const auto on = [this](QAction* action, auto what) {
    connect(action, &QAction::triggered, this, what);
  };
  on(actions.undo, [this] {
    if (EventEditor* editor = windowState_.events.editor()) editor->undoStack().undo();
  });
  on(actions.redo, [this] {
    if (EventEditor* editor = windowState_.events.editor()) editor->undoStack().redo();
  });
  on(actions.addLabel, [this] { add(kLabelKind, "Label", "label"); });
  on(actions.addNote, [this] { add(kNoteKind, "Note", "note"); });
  on(actions.addGrasp, [this] { addGrasp(); });
  on(actions.renameEvent, [this] { rename(); });
  on(actions.removeEvent, [this] {
    if (rows_.chosen()) windowState_.events.remove(*rows_.chosen());
  });
  on(actions.nextEvent, [this] { goToNext(1); });
  on(actions.previousEvent, [this] { goToNext(-1); });
  on(actions.toEvents, [this] { rows_.setFocus(); });
  on(actions.saveEvents, [this] {
    const OpenedRecordingPtr recording = windowState_.displayed.recorded();
    if (!recording || !windowState_.events.save(recording)) return;
    windowState_.messages.flash("labels, notes and grasps saved");
    windowState_.actionEnabler.refresh();
  });
}

void EventEditing::connectRows() {
  connect(&windowState_.events, &EventController::changed, this, [this] {
    // While a live source is shown, the marks of the recording and the chosen one are kept.
    if (!windowState_.displayed.isLive()) rows_.setMarks(windowState_.events.marks());
    if (!rows_.chosen()) walkedLane_.reset();
    showUndo();
    windowState_.actionEnabler.refresh();
  });
  connect(&rows_, &EventRows::markChosen, this, &EventEditing::show);
  connect(&rows_, &EventRows::chosenChanged, this, [this] {
    if (!rows_.chosen()) walkedLane_.reset();
    windowState_.actionEnabler.refresh();
  });
  connect(&rows_, &EventRows::removeRequested, &windowState_.events, &EventController::remove);
  connect(&rows_, &EventRows::textChanged, this, [this](std::size_t mark, const QString& text) {
    std::optional<Event> named;
    windowState_.events.change(
        mark,
        [&](Event& event) {
          event.text = text.toStdString();
          named = event;
        },
        "naming an event");
    if (named) chooseEvent(*named);
  });
  connect(&rows_, &EventRows::spanChanged, this, [this](std::size_t mark, double from, double to) {
    const OpenedRecordingPtr recording = windowState_.displayed.recorded();
    if (!recording) return;
    const double end = windowState_.selection.durationS();
    const std::int64_t fromUs = timeUsOf(*recording, std::clamp(from, 0.0, end));
    const std::int64_t toUs = timeUsOf(*recording, std::clamp(to, 0.0, end));
    std::optional<Event> moved;
    windowState_.events.change(
        mark,
        [&](Event& event) {
          event.tUs = fromUs;
          event.t1Us = toUs;
          moved = event;
        },
        "moving an event");
    if (to > from) windowState_.selection.setSpan(TimeSpan{from, to});
    // With its new span it is another mark.
    if (moved) choose(*moved);
  });
  connect(&rows_, &EventRows::menuRequested, this, [this](auto, const QPoint& at) {
    windowState_.menus.edit->popup(at);
  });
  // An event whose span is no longer selected isn't chosen any more: Del would delete what is out
  // of sight.
  connect(&windowState_.selection, &Selection::spanChanged, this, [this] {
    const auto chosen = rows_.chosen();
    if (!chosen || *chosen >= rows_.marks().size()) return;
    const EventMark& mark = rows_.marks()[*chosen];
    if (mark.toS <= mark.fromS || windowState_.selection.span()) return;
    rows_.choose(std::nullopt);
  });
  connect(windowState_.menus.edit, &QMenu::aboutToShow, this, [this] {
    showUndo();
    windowState_.actionEnabler.refresh();
  });
}

void EventEditing::addConditions() {
  const TimelineActions& actions = actions_;
  ActionEnabler& actionEnabler = windowState_.actionEnabler;
  const auto frames = [this] {
    return windowState_.events.editor() && windowState_.displayed.hasFrames();
  };
  const auto editable = [this, frames] {
    const auto chosen = rows_.chosen();
    return frames() && chosen && rows_.marks()[*chosen].editable;
  };
  const auto canUndo = [this](bool again) {
    EventEditor* editor = windowState_.events.editor();
    if (!editor) return false;
    return again ? editor->undoStack().canRedo() : editor->undoStack().canUndo();
  };
  actionEnabler.add(
      {actions.undo}, [canUndo] { return canUndo(false); }, "nothing to undo");
  actionEnabler.add({actions.redo}, [canUndo] { return canUndo(true); });
  actionEnabler.add(
      {actions.saveEvents},
      [this] {
        const EventEditor* editor = windowState_.events.editor();
        return editor && editor->unsaved();
      },
      "No recording with an unsaved label, note or grasp is shown");
  actionEnabler.add({actions.addLabel, actions.addNote}, frames);
  actionEnabler.add({actions.nextEvent, actions.previousEvent, actions.toEvents},
                    [this, frames] { return frames() && !rows_.marks().empty(); });
  actionEnabler.add({actions.removeEvent}, editable);
  // Without a chosen event, renaming says so.
  actionEnabler.add({actions.renameEvent}, frames);
  actionEnabler.add({actions.addGrasp}, [this, frames] {
    return frames() && windowState_.selection.span().has_value();
  });
}

void EventEditing::showUndo() {
  EventEditor* editor = windowState_.events.editor();
  const auto text = [editor](const QString& verb, bool can, const QString& what) {
    return editor && can ? verb + " " + what : verb;
  };
  QUndoStack* stack = editor ? &editor->undoStack() : nullptr;
  actions_.undo->setText(
      text("&Undo", stack && stack->canUndo(), stack ? stack->undoText() : QString()));
  actions_.redo->setText(
      text("&Redo", stack && stack->canRedo(), stack ? stack->redoText() : QString()));
}

void EventEditing::rename() {
  Messages& messages = windowState_.messages;
  const auto& marks = rows_.marks();
  const auto chosen = rows_.chosen();
  if (marks.empty())
    return messages.flash("there is no event to rename: Ctrl+B makes a label of the selection");
  if (!chosen || *chosen >= marks.size())
    return messages.flash(
        "choose an event first: N, or click one in the rows below the timeline; then F2 renames "
        "it");
  if (!marks[*chosen].editable)
    return messages.flash(marks[*chosen].text +
                          " can't be renamed: only grasps, labels and notes can");
  rows_.editText(*chosen);
}

// Chooses the event that was made just now, so that the keys for events act on it.
void EventEditing::choose(const Event& made) {
  chooseEvent(made);
  shownAtS_ = windowState_.playback.positionS();
}

void EventEditing::chooseEvent(const Event& event) {
  const EventEditor* editor = windowState_.events.editor();
  if (!editor) return;
  const auto& marks = rows_.marks();
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i].event && editor->events().at(*marks[i].event) == event) rows_.choose(i);
}

void EventEditing::goToNext(int step) {
  if (rows_.marks().empty()) return;
  const double nowS = windowState_.playback.positionS();
  const auto chosen = rows_.chosen();
  const bool moved = !chosen || !shownAtS_ || *shownAtS_ != nowS;
  const EventLane lane = walkedLane_.value_or(rows_.marks().at(chosen.value_or(0)).lane);
  if (!moved && rows_.marks()[*chosen].lane == lane) return rows_.chooseNext(step);
  // A label that was made at a grasp doesn't end the way from grasp to grasp.
  rows_.chooseNextFrom(nowS, step, lane, !moved);
}

// Moves the cursor to the begin of the mark, selects its span, and scrolls it into view.
void EventEditing::show(std::size_t index) {
  const EventMark mark = rows_.marks().at(index);
  walkedLane_ = mark.lane;
  Selection& selection = windowState_.selection;
  const TimeSpan seen = selection.visibleSpan();
  const double spanS = seen.toS - seen.fromS;
  if (mark.toS - mark.fromS > spanS)
    selection.showWithMargin({mark.fromS, mark.toS});
  else if (mark.fromS < seen.fromS || mark.toS > seen.toS)
    selection.show({(mark.fromS + mark.toS - spanS) / 2, (mark.fromS + mark.toS + spanS) / 2});
  windowState_.playback.seekSeconds(mark.fromS);
  shownAtS_ = windowState_.playback.positionS();
  selection.setSpan(mark.toS > mark.fromS ? std::optional(TimeSpan{mark.fromS, mark.toS})
                                          : std::nullopt);
  windowState_.actionEnabler.refresh();
}

// Adds an event with the selected span or, without a selection, at the time of the cursor.
void EventEditing::add(const char* kind, const QString& title, const QString& name) {
  const OpenedRecordingPtr recording = windowState_.displayed.recorded();
  if (!recording || !windowState_.playback.hasFrames()) return;
  const auto& span = windowState_.selection.span();
  Event event;
  event.kind = kind;
  event.tUs = timeUsOf(*recording, span ? span->fromS : windowState_.playback.positionS());
  event.t1Us = span ? timeUsOf(*recording, span->toS) : event.tUs;
  const double fromS = span ? span->fromS : windowState_.playback.positionS();
  const QString when = span ? " from " + figure(fromS, 2) + " s to " + figure(span->toS, 2) + " s"
                            : " at " + figure(fromS, 2) + " s";
  const QString heading = title + when + " in " + fileNameOf(*recording);
  const auto text = windowState_.ask.text(heading, heading + ":", {});
  if (!text) return;
  if (text->isEmpty()) return windowState_.messages.flash("a " + name + " needs a text");
  event.text = text->toStdString();
  windowState_.events.add(event, "a " + name);
  choose(event);
}

void EventEditing::addGrasp() {
  const OpenedRecordingPtr recording = windowState_.displayed.recorded();
  if (!recording || !windowState_.playback.hasFrames()) return;
  const auto& span = windowState_.selection.span();
  if (!span)
    return windowState_.messages.flash(
        "nothing is selected: drag in the timeline, or press [ and ]");
  Event event;
  event.kind = kSegmentKind;
  event.tUs = timeUsOf(*recording, span->fromS);
  event.t1Us = timeUsOf(*recording, span->toS);
  event.text = kGraspText;
  windowState_.events.addGrasp(event);
  choose(event);
}

}  // namespace palpate::gui

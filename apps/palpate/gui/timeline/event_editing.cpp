#include "gui/timeline/event_editing.h"

#include <QMenu>
#include <QMessageBox>
#include <QUndoStack>
#include <algorithm>

#include "gui/timeline/event_rows.h"

namespace palpate::gui {

EventEditing::EventEditing(Bench& bench,
                           const TimelineActions& actions,
                           EventRows& rows,
                           QWidget* window)
    : bench_(bench), actions_(actions), rows_(rows) {
  bench.questions.unsaved = [window](const QString& names) {
    QMessageBox box(QMessageBox::Question,
                    "Palpate",
                    "Labels, notes or grasps were changed and not saved:\n" + names,
                    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel,
                    window);
    const int answer = box.exec();
    return answer == QMessageBox::Save      ? Questions::Unsaved::kSave
           : answer == QMessageBox::Discard ? Questions::Unsaved::kDiscard
                                            : Questions::Unsaved::kCancel;
  };
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
    if (EventEditor* editor = bench_.events.editor()) editor->undoStack().undo();
  });
  on(actions.redo, [this] {
    if (EventEditor* editor = bench_.events.editor()) editor->undoStack().redo();
  });
  on(actions.addLabel, [this] { add(kLabelKind, "Label", "label"); });
  on(actions.addNote, [this] { add(kNoteKind, "Note", "note"); });
  on(actions.addGrasp, [this] { addGrasp(); });
  on(actions.renameEvent, [this] {
    if (rows_.chosen()) rows_.editText(*rows_.chosen());
  });
  on(actions.removeEvent, [this] {
    if (rows_.chosen()) bench_.events.remove(*rows_.chosen());
  });
  on(actions.nextEvent, [this] { rows_.chooseNext(1); });
  on(actions.previousEvent, [this] { rows_.chooseNext(-1); });
  on(actions.toEvents, [this] { rows_.setFocus(); });
  on(actions.saveEvents, [this] {
    const OpenedRecordingPtr recording = bench_.subject.recorded();
    if (!recording || !bench_.events.save(recording)) return;
    bench_.messages.flash("labels, notes and grasps saved");
    bench_.enabling.refresh();
  });
}

void EventEditing::connectRows() {
  connect(&bench_.events, &EventDesk::changed, this, [this] {
    // Behind what is live they stay, with the one that is chosen.
    if (!bench_.subject.isLive()) rows_.setMarks(bench_.events.marks());
    showUndo();
    bench_.enabling.refresh();
  });
  connect(&rows_, &EventRows::markChosen, this, &EventEditing::show);
  connect(&rows_, &EventRows::chosenChanged, this, [this] { bench_.enabling.refresh(); });
  connect(&rows_, &EventRows::removeAsked, &bench_.events, &EventDesk::remove);
  connect(&rows_, &EventRows::textChanged, this, [this](std::size_t mark, const QString& text) {
    bench_.events.change(
        mark,
        [text](RecordingEvent& event) { event.text = text.toStdString(); },
        "naming an event");
  });
  connect(&rows_, &EventRows::spanChanged, this, [this](std::size_t mark, double from, double to) {
    const OpenedRecordingPtr recording = bench_.subject.recorded();
    if (!recording) return;
    const double end = bench_.selection.durationS();
    const std::int64_t fromUs = timeUsOf(*recording, std::clamp(from, 0.0, end));
    const std::int64_t toUs = timeUsOf(*recording, std::clamp(to, 0.0, end));
    bench_.events.change(
        mark,
        [=](RecordingEvent& event) {
          event.tUs = fromUs;
          event.t1Us = toUs;
        },
        "moving an event");
    if (to > from) bench_.selection.setSpan(TimeSpan{from, to});
  });
  connect(&rows_, &EventRows::menuAsked, this, [this](auto, const QPoint& at) {
    bench_.menus.edit->popup(at);
  });
  connect(bench_.menus.edit, &QMenu::aboutToShow, this, [this] {
    showUndo();
    bench_.enabling.refresh();
  });
}

void EventEditing::addConditions() {
  const TimelineActions& actions = actions_;
  Enabling& enabling = bench_.enabling;
  const auto frames = [this] { return bench_.events.editor() && bench_.subject.hasFrames(); };
  const auto editable = [this, frames] {
    const auto chosen = rows_.chosen();
    return frames() && chosen && rows_.marks()[*chosen].editable;
  };
  const auto canUndo = [this](bool again) {
    EventEditor* editor = bench_.events.editor();
    if (!editor) return false;
    return again ? editor->undoStack().canRedo() : editor->undoStack().canUndo();
  };
  enabling.add({actions.undo}, [canUndo] { return canUndo(false); });
  enabling.add({actions.redo}, [canUndo] { return canUndo(true); });
  enabling.add({actions.saveEvents}, [this] {
    const EventEditor* editor = bench_.events.editor();
    return editor && editor->unsaved();
  });
  enabling.add({actions.addLabel, actions.addNote}, frames);
  enabling.add({actions.nextEvent, actions.previousEvent, actions.toEvents},
               [this, frames] { return frames() && !rows_.marks().empty(); });
  enabling.add({actions.renameEvent, actions.removeEvent}, editable);
  enabling.add({actions.addGrasp},
               [this, frames] { return frames() && bench_.selection.span().has_value(); });
}

void EventEditing::showUndo() {
  EventEditor* editor = bench_.events.editor();
  const auto text = [editor](const QString& verb, bool can, const QString& what) {
    return editor && can ? verb + " " + what : verb;
  };
  QUndoStack* stack = editor ? &editor->undoStack() : nullptr;
  actions_.undo->setText(
      text("&Undo", stack && stack->canUndo(), stack ? stack->undoText() : QString()));
  actions_.redo->setText(
      text("&Redo", stack && stack->canRedo(), stack ? stack->redoText() : QString()));
}

// The cursor goes to its begin, its span is selected, and it is brought into sight.
void EventEditing::show(std::size_t index) {
  const EventMark mark = rows_.marks().at(index);
  Selection& selection = bench_.selection;
  const TimeSpan seen = selection.inSight();
  const double spanS = seen.toS - seen.fromS;
  if (mark.toS - mark.fromS > spanS)
    selection.showWithAir({mark.fromS, mark.toS});
  else if (mark.fromS < seen.fromS || mark.toS > seen.toS)
    selection.show({(mark.fromS + mark.toS - spanS) / 2, (mark.fromS + mark.toS + spanS) / 2});
  bench_.playback.seekSeconds(mark.fromS);
  selection.setSpan(mark.toS > mark.fromS ? std::optional(TimeSpan{mark.fromS, mark.toS})
                                          : std::nullopt);
  bench_.enabling.refresh();
}

// Of the selection, or of the moment.
void EventEditing::add(const char* kind, const QString& title, const QString& name) {
  const OpenedRecordingPtr recording = bench_.subject.recorded();
  if (!recording || !bench_.playback.hasFrames()) return;
  const auto& span = bench_.selection.span();
  RecordingEvent event;
  event.kind = kind;
  event.tUs = timeUsOf(*recording, span ? span->fromS : bench_.playback.positionS());
  event.t1Us = span ? timeUsOf(*recording, span->toS) : event.tUs;
  const auto text = bench_.questions.text(title, {});
  if (!text) return;
  if (text->isEmpty()) return bench_.messages.flash("a " + name + " needs words");
  event.text = text->toStdString();
  bench_.events.add(event, "a " + name);
}

void EventEditing::addGrasp() {
  const OpenedRecordingPtr recording = bench_.subject.recorded();
  if (!recording || !bench_.playback.hasFrames()) return;
  const auto& span = bench_.selection.span();
  if (!span)
    return bench_.messages.flash("nothing is selected: drag in the timeline, or press [ and ]");
  RecordingEvent event;
  event.kind = kSegmentKind;
  event.tUs = timeUsOf(*recording, span->fromS);
  event.t1Us = timeUsOf(*recording, span->toS);
  event.text = kGraspText;
  bench_.events.addGrasp(event);
}

}  // namespace palpate::gui

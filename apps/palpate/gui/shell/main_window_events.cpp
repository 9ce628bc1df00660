// The main window's events: grasps, gaps, labels and notes in rows below the timeline, edited with undo.
#include <QInputDialog>
#include <QMenu>
#include <QMessageBox>

#include <palpate/core/error.h>
#include <palpate/recording/event_store.h>

#include "gui/inspect/inspect_panel.h"
#include "gui/shell/main_window_calibrate.h"
#include "gui/shell/main_window_slip.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/widgets/message_banner.h"

namespace palpate::gui {

void MainWindow::connectEvents() {
  askAboutUnsaved = [this](const QString& names) {
    QMessageBox box(QMessageBox::Question,
                    "Palpate",
                    "Labels, notes or grasps were changed and not saved:\n" + names,
                    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel,
                    this);
    const int answer = box.exec();
    return answer == QMessageBox::Save      ? Unsaved::kSave
           : answer == QMessageBox::Discard ? Unsaved::kDiscard
                                            : Unsaved::kCancel;
  };
  EventRows& rows = timelinePanel_->rows();
  const auto on = [this](QAction* action, auto what) {
    connect(action, &QAction::triggered, this, what);
  };
  on(actions_.undo, [this] {
    if (EventEditor* editor = events()) editor->undoStack().undo();
  });
  on(actions_.redo, [this] {
    if (EventEditor* editor = events()) editor->undoStack().redo();
  });
  on(actions_.addLabel, [this] { addEvent(kLabelKind, "Label", "label"); });
  on(actions_.addNote, [this] { addEvent(kNoteKind, "Note", "note"); });
  on(actions_.addGrasp, [this] { addEvent(kSegmentKind, {}, "grasp"); });
  on(actions_.renameEvent, [this, &rows] {
    if (rows.chosen()) rows.editText(*rows.chosen());
  });
  on(actions_.removeEvent, [this, &rows] {
    if (rows.chosen()) removeEvent(*rows.chosen());
  });
  on(actions_.nextEvent, [&rows] { rows.chooseNext(1); });
  on(actions_.previousEvent, [&rows] { rows.chooseNext(-1); });
  on(actions_.toEvents, [&rows] { rows.setFocus(); });
  on(actions_.saveEvents, [this] {
    if (current_ && saveEventsOf(current_)) flash("labels, notes and grasps saved");
  });
  connect(&rows, &EventRows::markChosen, this, &MainWindow::eventChosen);
  connect(&rows, &EventRows::chosenChanged, this, &MainWindow::enableEventActions);
  connect(&rows, &EventRows::removeAsked, this, &MainWindow::removeEvent);
  connect(&rows, &EventRows::textChanged, this, [this](std::size_t mark, const QString& text) {
    changeEvent(
        mark,
        [text](RecordingEvent& event) { event.text = text.toStdString(); },
        "naming an event");
  });
  connect(&rows, &EventRows::spanChanged, this, [this](std::size_t mark, double from, double to) {
    const double end = timeline_->durationS();
    const std::int64_t fromUs = timeUsOf(*current_, std::clamp(from, 0.0, end));
    const std::int64_t toUs = timeUsOf(*current_, std::clamp(to, 0.0, end));
    changeEvent(
        mark,
        [=](RecordingEvent& event) {
          event.tUs = fromUs;
          event.t1Us = toUs;
        },
        "moving an event");
    if (to > from) timeline_->setSelection(TimeSpan{from, to});
  });
  const auto menu = [this](const QPoint& at) { menus_->edit->popup(at); };
  connect(&rows, &EventRows::menuAsked, this, [menu](auto, const QPoint& at) { menu(at); });
  connect(timeline_, &TimelineChart::menuAsked, this, menu);
  connect(menus_->edit, &QMenu::aboutToShow, this, &MainWindow::enableEventActions);
}

EventEditor* MainWindow::events() {
  if (!current_ || liveShown_) return nullptr;
  auto& editor = editors_[current_.get()];
  if (!editor) {
    editor = std::make_unique<EventEditor>(
        current_->events,
        [path = current_->path](const EventsReport& asRead,
                                const std::vector<RecordingEvent>& now) {
          palpate::saveEvents(path, asRead, now);
        });
    connect(editor.get(), &EventEditor::changed, this, &MainWindow::showEvents);
  }
  return editor.get();
}

const std::vector<GraspSegment>& MainWindow::graspsOf(const OpenedRecordingPtr& recording) {
  const auto known = grasps_.find(recording.get());
  if (known != grasps_.end()) return known->second;
  auto& found = grasps_[recording.get()];
  if (!recording->isLong())
    return found = findGrasps(recording->profile, recording->table, recording->timing);
  // Of hours: beside the window.
  auto result = std::make_shared<std::vector<GraspSegment>>();
  finder_.start(
      {},
      [result, recording](const Progress& progress) {
        *result = findGrasps(recording->profile, {}, progress);
      },
      [this, result, recording] {
        if (!grasps_.contains(recording.get())) return;  // closed meanwhile
        grasps_[recording.get()] = std::move(*result);
        showEvents();
      });
  return found;
}

void MainWindow::showEvents() {
  if (liveShown_) return;
  EventRows& rows = timelinePanel_->rows();
  std::vector<EventMark> marks;
  if (EventEditor* editor = events()) {
    marks = marksOf(*current_, editor->events(), graspsOf(current_));
    calibrate_->addSteps(marks);
    slip_->addSlips(marks);
    inspect_->showEvents(editor->events());
  }
  rows.setMarks(std::move(marks));
  enableEventActions();
}

void MainWindow::enableEventActions() {
  EventEditor* editor = events();
  const bool frames = editor && playback_.hasFrames();
  const EventRows& rows = timelinePanel_->rows();
  const auto chosen = rows.chosen();
  const bool editable = frames && chosen && rows.marks()[*chosen].editable;
  const bool selected = frames && timeline_->selection().has_value();
  actions_.undo->setEnabled(editor && editor->undoStack().canUndo());
  actions_.redo->setEnabled(editor && editor->undoStack().canRedo());
  actions_.undo->setText(editor && editor->undoStack().canUndo()
                             ? "&Undo " + editor->undoStack().undoText()
                             : QString("&Undo"));
  actions_.redo->setText(editor && editor->undoStack().canRedo()
                             ? "&Redo " + editor->undoStack().redoText()
                             : QString("&Redo"));
  actions_.saveEvents->setEnabled(editor && editor->unsaved());
  for (QAction* action : {actions_.addLabel,
                          actions_.addNote,
                          actions_.selectFrom,
                          actions_.selectTo,
                          actions_.selectAll,
                          actions_.chooseCurves})
    action->setEnabled(frames);
  for (QAction* action : {actions_.nextEvent, actions_.previousEvent, actions_.toEvents})
    action->setEnabled(frames && !rows.marks().empty());
  for (QAction* action : {actions_.renameEvent, actions_.removeEvent}) action->setEnabled(editable);
  for (QAction* action :
       {actions_.addGrasp, actions_.crop, actions_.zoomSelection, actions_.dropSelection})
    action->setEnabled(selected);
  if (current_ && !liveShown_) {
    const QString star = editor && editor->unsaved() ? "*" : "";
    setWindowTitle(fileNameOf(*current_) + star + " – Palpate");
  }
}

// The cursor goes to its begin, its span is selected, and it is brought into sight.
void MainWindow::eventChosen(std::size_t index) {
  const EventMark mark = timelinePanel_->rows().marks().at(index);
  const QCPRange seen = timeline_->seen();
  const double spanS = seen.size();
  if (mark.toS - mark.fromS > spanS)
    timeline_->showSpan({mark.fromS, mark.toS});
  else if (mark.fromS < seen.lower || mark.toS > seen.upper)
    timeline_->setSeen((mark.fromS + mark.toS - spanS) / 2, (mark.fromS + mark.toS + spanS) / 2);
  playback_.seekSeconds(mark.fromS);
  timeline_->setSelection(mark.toS > mark.fromS ? std::optional(TimeSpan{mark.fromS, mark.toS})
                                                : std::nullopt);
  enableEventActions();
}

void MainWindow::addEvent(const char* kind, const QString& title, const QString& name) {
  EventEditor* editor = events();
  if (!editor || !playback_.hasFrames()) return;
  const auto& selection = timeline_->selection();
  RecordingEvent event;
  event.kind = kind;
  event.tUs = timeUsOf(*current_, selection ? selection->fromS : playback_.positionS());
  event.t1Us = selection ? timeUsOf(*current_, selection->toS) : event.tUs;
  if (event.kind == kSegmentKind) {
    if (!selection) return flash("nothing is selected: drag in the timeline, or press [ and ]");
    event.text = kGraspText;
    return editor->changeTogether("a grasp", [&] {
      keepFoundGrasps(*editor, std::nullopt);
      editor->add(event, "a grasp");
    });
  }
  const auto text = askForText(title, {});
  if (!text) return;
  if (text->isEmpty()) return flash("a " + name + " needs words");
  event.text = text->toStdString();
  editor->add(event, "a " + name);
}

// What was found becomes what a person says: all but `without`, which is being changed.
void MainWindow::keepFoundGrasps(EventEditor& editor, std::optional<std::size_t> without) {
  const auto isSegment = [](const RecordingEvent& event) { return event.kind == kSegmentKind; };
  const auto& now = editor.events();
  for (std::size_t i = 0; i < now.size(); ++i)
    if (saysNoGrasp(now[i])) return editor.remove(i, "grasps");
  if (std::any_of(now.begin(), now.end(), isSegment)) return;
  const std::vector<GraspSegment>& found = graspsOf(current_);
  for (std::size_t i = 0; i < found.size(); ++i)
    if (i != without) editor.add(segmentOf(*current_, found[i]), "grasps");
}

void MainWindow::changeEvent(std::size_t index,
                             const std::function<void(RecordingEvent&)>& change,
                             const QString& name) {
  EventEditor* editor = events();
  const EventMark mark = timelinePanel_->rows().marks().at(index);
  if (!editor || !mark.editable) return;
  if (mark.event) {
    RecordingEvent changed = editor->events().at(*mark.event);
    change(changed);
    return editor->change(*mark.event, changed, name);
  }
  RecordingEvent changed = segmentOf(*current_, graspsOf(current_).at(*mark.grasp));
  change(changed);
  editor->changeTogether(name, [&] {
    keepFoundGrasps(*editor, mark.grasp);
    editor->add(changed, name);
  });
}

void MainWindow::removeEvent(std::size_t index) {
  EventEditor* editor = events();
  const EventMark mark = timelinePanel_->rows().marks().at(index);
  if (!editor || !mark.editable) return;
  const QString name = mark.lane == EventLane::kGrasps ? "deleting a grasp" : "deleting an event";
  editor->changeTogether(name, [&] {
    if (mark.event)
      editor->remove(*mark.event, name);
    else
      keepFoundGrasps(*editor, mark.grasp);
    const auto& now = editor->events();
    const bool none = std::none_of(now.begin(), now.end(), [](const RecordingEvent& event) {
      return event.kind == kSegmentKind;
    });
    // Else what was found would come back.
    if (mark.lane == EventLane::kGrasps && none) editor->add(noGrasp(*current_), name);
  });
}

bool MainWindow::saveEventsOf(const OpenedRecordingPtr& recording) {
  if (!hasUnsaved(recording)) return true;
  try {
    editors_.at(recording.get())->save();
    return true;
  } catch (const std::exception& error) {
    banner_->showMessage("Labels, notes and grasps were not saved: " +
                         QString::fromUtf8(error.what()));
    return false;
  }
}

bool MainWindow::hasUnsaved(const OpenedRecordingPtr& recording) const {
  const auto editor = editors_.find(recording.get());
  return editor != editors_.end() && editor->second && editor->second->unsaved();
}

bool MainWindow::settleUnsaved(const std::vector<OpenedRecordingPtr>& recordings) {
  std::vector<OpenedRecordingPtr> unsaved;
  QStringList names;
  for (const OpenedRecordingPtr& recording : recordings) {
    if (!hasUnsaved(recording)) continue;
    unsaved.push_back(recording);
    names.append(fileNameOf(*recording));
  }
  if (unsaved.empty()) return true;
  const Unsaved answer = askAboutUnsaved(names.join("\n"));
  if (answer == Unsaved::kCancel) return false;
  if (answer == Unsaved::kDiscard) return true;
  bool saved = true;
  for (const OpenedRecordingPtr& recording : unsaved) saved = saveEventsOf(recording) && saved;
  return saved;
}

}  // namespace palpate::gui

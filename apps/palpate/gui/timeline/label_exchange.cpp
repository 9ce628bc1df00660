#include "gui/timeline/label_exchange.h"

#include <QFileInfo>
#include <algorithm>
#include <utility>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>
#include <palpate/core/text_file.h>

#include "gui/appearance/captions.h"

namespace palpate::gui {
namespace {

constexpr const char* kTableFilter = "Table (*.csv);;All files (*)";
constexpr qsizetype kMaxProblems = 3;
// Topic of the message about an import.
constexpr const char* kImportTopic = "import of labels";

QString labelCount(std::size_t count) { return QString::fromStdString(counted(count, "label")); }

// "2 labels, 1 note, 1 marked grasp"; "0 labels"
QString countsOf(const std::vector<Event>& events) {
  QStringList counts;
  for (const auto& [kind, noun] : {std::pair<const char*, const char*>{"label", "label"},
                                   {"note", "note"},
                                   {"segment", "marked grasp"}}) {
    const auto number = std::count_if(
        events.begin(), events.end(), [&](const Event& event) { return event.kind == kind; });
    if (number > 0)
      counts.append(
          QString::fromStdString(counted(static_cast<std::uint64_t>(number), std::string(noun))));
  }
  return counts.isEmpty() ? labelCount(0) : counts.join(", ");
}

// Throws Error with one line for the user, which names the file.
LabelTable tableIn(const QString& path, const OpenedRecording& recording) {
  const std::string text = readTextFile(path.toStdString(), kMaxLabelTableBytes);
  try {
    return readLabelTable(text, recording.profile, recording.path);
  } catch (const Error& error) {
    throw FormatError(path.toStdString(), error.what());
  }
}

}  // namespace

LabelExchange::LabelExchange(WindowState& windowState, QObject* parent)
    : QObject(parent), windowState_(windowState) {
  ActionRegistry& book = windowState.actions;
  QAction* exported = book.make("exportLabels", "File", "Export labels…");
  exported->setToolTip("Export labels, notes and marked grasps as a table (CSV)");
  QAction* imported = book.make("importLabels", "File", "Import labels…");
  imported->setToolTip("Add the labels of a table (CSV): begin_s, end_s, kind, text, matrix");
  connect(exported, &QAction::triggered, this, &LabelExchange::exportLabels);
  connect(imported, &QAction::triggered, this, &LabelExchange::importLabels);
  connect(&windowState.events, &EventController::changed, this, &LabelExchange::withdrawWhenUndone);
  const auto editable = [this] {
    return windowState_.events.editor() && windowState_.displayed.hasFrames();
  };
  windowState.actionEnabler.add({imported}, editable);
  windowState.actionEnabler.add({exported}, [this, editable] {
    if (!editable()) return false;
    const auto& events = windowState_.events.editor()->events();
    return std::any_of(events.begin(), events.end(), isTabledLabel);
  });
}

void LabelExchange::exportLabels() {
  const OpenedRecordingPtr recording = windowState_.displayed.recorded();
  EventEditor* editor = windowState_.events.editor();
  if (!recording || !editor) return;
  const auto& events = editor->events();
  const auto count =
      static_cast<std::size_t>(std::count_if(events.begin(), events.end(), isTabledLabel));
  if (count == 0) return windowState_.messages.flash("there are no labels to export");
  const QFileInfo source(pathText(recording->path));
  QString path = windowState_.ask.newFile(
      "Export labels",
      source.absolutePath() + "/" + source.completeBaseName() + "_labels.csv",
      kTableFilter);
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += ".csv";
  try {
    // The dialogue has already asked whether an existing file may be replaced.
    writeTableFile(*labelRows(events, recording->profile), path.toStdString(), Overwrite::kReplace);
    windowState_.messages.flash("written: " + path + " (" + labelCount(count) + ")");
  } catch (const Error& error) {
    windowState_.messages.fail(QString::fromUtf8(error.what()));
  }
}

// Shows a failure until another import begins or the recording is not shown any more; one that
// added labels, until it is undone.
void LabelExchange::fail(const QString& message, EventEditor* in, bool added) {
  failed_ = true;
  failedIn_ = in;
  failedAt_ = failedIn_ && added ? failedIn_->undoStack().index() : 0;
  windowState_.messages.failAbout(kImportTopic, message);
}

void LabelExchange::withdrawWhenUndone() {
  if (!failed_) return;
  if (failedIn_ && failedIn_ == windowState_.events.editor() &&
      failedIn_->undoStack().index() >= failedAt_)
    return;
  failed_ = false;
  windowState_.messages.withdraw(kImportTopic);
}

void LabelExchange::importLabels() {
  const OpenedRecordingPtr recording = windowState_.displayed.recorded();
  if (!recording || !windowState_.events.editor()) return;
  const QString path = windowState_.ask.file(
      "Import labels", QFileInfo(pathText(recording->path)).absolutePath(), kTableFilter);
  // The dialogue runs an event loop: the recording may have been closed meanwhile.
  EventEditor* editor = windowState_.events.editor();
  if (path.isEmpty() || !editor || windowState_.displayed.recorded() != recording) return;
  windowState_.messages.withdraw(kImportTopic);
  reading_.start(
      [this, path, recording, editor = QPointer(editor)]() -> FileReading::Take {
        return [this, path, editor, table = tableIn(path, *recording)] {
          if (editor) return take(table, path, *editor);
          windowState_.messages.flash(QFileInfo(path).fileName() +
                                      ": no labels added, the recording was closed");
        };
      },
      [this](const QString& problem) { fail(problem, windowState_.events.editor(), false); });
  windowState_.messages.flash("reading " + QFileInfo(path).fileName() + "…");
}

void LabelExchange::take(const LabelTable& table, const QString& path, EventEditor& editor) {
  const std::vector<Event> added = newLabels(table, editor.events());
  editor.add(added, "importing labels");
  const std::size_t known = table.events.size() - added.size();
  QString said = QFileInfo(path).fileName() + ": " + countsOf(added) + " added";
  if (known > 0)
    said += ", " + QString::number(known) + (known == 1 ? " was" : " were") + " there already";
  if (table.numOthers > 0)
    said += "; " + QString::number(table.numOthers) + " of other recordings not taken";
  if (table.problems.empty()) return windowState_.messages.flash(said);
  QStringList problems;
  for (const std::string& problem : table.problems) {
    if (problems.size() == kMaxProblems) break;
    problems.append(QString::fromStdString(problem));
  }
  const auto bad = static_cast<qsizetype>(table.problems.size());
  if (table.more)
    problems.append("and more");
  else if (bad > kMaxProblems)
    problems.append(QString::number(bad - kMaxProblems) + " more");
  fail(said + "; left out: " + problems.join("; "), &editor, !added.empty());
}

}  // namespace palpate::gui

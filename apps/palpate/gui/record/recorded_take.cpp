#include "gui/record/recorded_take.h"

#include <QFile>
#include <utility>

#include <palpate/capture/recording_name.h>
#include <palpate/core/error.h>
#include <palpate/core/number_text.h>
#include <palpate/library/recording_files.h>

#include "gui/appearance/captions.h"
#include "gui/desktop/trash.h"

namespace palpate::gui {
namespace fs = std::filesystem;
namespace {

// "run_001.palpate", "run_001.palpate and 2 more parts".
QString nameOfTake(const std::vector<fs::path>& paths) {
  QString name = pathText(paths.front().filename());
  if (paths.size() > 1)
    name += " and " + QString::fromStdString(counted(paths.size() - 1, "more part"));
  return name;
}

// A typed name as the stem of a file; empty: it is none.
std::string stemFromText(QString typed) {
  typed = typed.trimmed();
  if (typed.endsWith(".palpate")) typed.chop(8);
  return fileNamePart(typed.toStdString());
}

}  // namespace

RecordedTake::RecordedTake(WindowState& windowState, QObject* parent)
    : QObject(parent), moveToTrash(moveFileToTrash), windowState_(windowState) {}

void RecordedTake::set(const std::vector<fs::path>& paths) {
  paths_ = paths;
  emit changed();
}

std::vector<OpenedRecordingPtr> RecordedTake::opened() const {
  std::vector<OpenedRecordingPtr> open;
  for (const fs::path& path : paths_)
    if (const OpenedRecordingPtr recording = windowState_.recordings.at(path))
      open.push_back(recording);
  return open;
}

void RecordedTake::close(const std::vector<OpenedRecordingPtr>& recordings) {
  for (const OpenedRecordingPtr& recording : recordings) {
    const bool shown = windowState_.displayed.unfilteredRecording() == recording;
    const bool live = windowState_.displayed.isLive();
    const OpenedRecordingPtr next = windowState_.recordings.close(recording);
    if (shown) windowState_.displayed.show(live ? nullptr : next);
  }
}

void RecordedTake::rename() {
  if (paths_.empty()) return;
  const std::vector<OpenedRecordingPtr> open = opened();
  if (!windowState_.events.settle(open)) return;
  const bool shown = !open.empty() && windowState_.displayed.recorded() == open.front();
  const QString heading = "Rename " + nameOfTake(paths_);
  QString question = heading;
  QString name = pathText(paths_.front().stem());
  for (;;) {
    const auto typed = windowState_.ask.text(heading, question + ":", name);
    if (!typed) return;
    try {
      const std::string stem = stemFromText(*typed);
      if (stem.empty()) throw Error("that is not a valid file name");
      const std::vector<fs::path> named = renameRecording(paths_, stem);
      close(open);
      const fs::path from = std::exchange(paths_, named).front();
      if (!open.empty())
        windowState_.open(named, shown ? OpenRequest::Then::kShowFirst : OpenRequest::Then::kList);
      windowState_.messages.logLink("renamed " + pathText(from.filename()) + ": now " +
                                    nameOfTake(paths_));
      emit renamed(from, paths_.front());
      emit changed();
      return;
    } catch (const std::exception& refusal) {
      const QString why = QString::fromUtf8(refusal.what());
      question = why;
      // Asked once more with what was typed; typed again, it is refused.
      if (*typed == name) return windowState_.messages.fail(why);
      name = *typed;
    }
  }
}

QStringList RecordedTake::keepWhatIsThere() {
  const fs::path first = paths_.front();
  std::erase_if(paths_, [](const fs::path& part) { return filesOfRecording(part).empty(); });
  QStringList names;
  for (const fs::path& part : paths_)
    for (const fs::path& file : filesOfRecording(part)) names << pathText(file.filename());
  if (paths_.empty())
    emit discarded(first);
  else if (paths_.front() != first)
    emit beginsWith(paths_.front(), first);
  emit changed();
  return names;
}

void RecordedTake::keepRest(const QString& why, const QStringList& moved) {
  QString text = moved.isEmpty() ? "Not discarded" : "Partly discarded";
  if (!why.isEmpty()) text += ": " + why;
  if (!moved.isEmpty()) text += "; in the trash: " + moved.join(", ");
  if (const QStringList kept = keepWhatIsThere(); !kept.isEmpty())
    text += "; kept: " + kept.join(", ");
  windowState_.messages.fail(text);
}

bool RecordedTake::discardFiles(QStringList& moved) {
  requireNotBeingWritten(paths_);
  bool trashed = true;
  for (const fs::path& path : paths_)
    for (const fs::path& file : filesOfRecording(path)) {
      trashed = trashed && moveToTrash(pathText(file));
      if (trashed) moved << pathText(file.filename());
    }
  if (trashed) {
    removeFreeLocks(paths_);
    windowState_.messages.flash("moved to the trash: " + nameOfTake(paths_));
    return true;
  }
  const QString why =
      moved.isEmpty()
          ? "The desktop has no trash for " + pathText(paths_.front().parent_path()) + ". Delete " +
                nameOfTake(paths_)
          : "Only " + moved.join(", ") + " could be moved to the trash. Delete the rest of " +
                nameOfTake(paths_);
  if (!windowState_.ask.confirmed(why + " for good?", "Delete")) return false;
  deleteRecording(paths_);
  windowState_.messages.flash("deleted: " + nameOfTake(paths_));
  return true;
}

void RecordedTake::discard() {
  if (paths_.empty()) return;
  if (!windowState_.ask.confirmed("Discard " + nameOfTake(paths_) + "? It is moved to the trash.",
                                  "Discard"))
    return;
  QStringList moved;
  try {
    requireNotBeingWritten(paths_);
    close(opened());
    if (!discardFiles(moved)) {
      if (!moved.isEmpty()) keepRest({}, moved);
      return;
    }
    windowState_.messages.logLink("discarded " + nameOfTake(paths_));
    const fs::path gone = std::exchange(paths_, {}).front();
    emit discarded(gone);
    emit changed();
  } catch (const Error& error) {
    keepRest(QString::fromUtf8(error.what()), moved);
  }
}

}  // namespace palpate::gui

// Where the user was: in each recording that is open, and from one day to the next.
#include <QFileInfo>
#include <algorithm>

#include "gui/shell/main_window.h"
#include "gui/source/recent_files.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/widgets/message_banner.h"

namespace palpate::gui {

// Of the recording that is shown.
void MainWindow::noteWhereWeAre() {
  if (!current_) return;
  LeftAt& left = leftAt_[current_->path];
  left.frame = playback_.frame();
  const QCPRange seen = timeline_->seen();
  const bool whole = seen.size() > timeline_->durationS() * 0.9999;
  left.seen = whole ? std::nullopt : std::optional(TimeSpan{seen.lower, seen.upper});
  left.selection = timeline_->selection();
}

void MainWindow::goBackToWhereWeWere() {
  const auto left = leftAt_.find(current_->path);
  if (left == leftAt_.end()) return playback_.seekFrame(0);
  playback_.seekFrame(left->second.frame);
  if (left->second.seen) timeline_->setSeen(left->second.seen->fromS, left->second.seen->toS);
  timeline_->setSelection(left->second.selection);
}

void MainWindow::rememberSession() {
  if (!liveShown_) noteWhereWeAre();
  Session session;
  for (const OpenedRecordingPtr& recording : recordings_.all()) {
    if (recording->path == demoPath_) continue;
    if (recording == current_) session.current = static_cast<int>(session.files.size());
    const QString path = QString::fromStdString(recording->path.string());
    session.files.push_back({QFileInfo(path).absoluteFilePath(), leftAt_[recording->path]});
  }
  saveSession(session, settings_);
}

void MainWindow::restoreSession() {
  const Session session = loadSession(settings_);
  std::vector<std::filesystem::path> files;
  QStringList missing;
  for (const Session::File& file : session.files) {
    const std::filesystem::path path = file.path.toStdString();
    if (!RecentFiles::exists(file.path)) {
      missing.append(QFileInfo(file.path).fileName());
      continue;
    }
    leftAt_[path] = file.leftAt;
    files.push_back(path);
    // The first that can be opened is shown: that is the one that was.
    if (session.current >= 0 && &file == &session.files[static_cast<std::size_t>(session.current)])
      std::rotate(files.begin(), files.end() - 1, files.end());
  }
  openFiles(files);
  if (!missing.isEmpty())
    banner_->showMessage("Open last time, and not there any more: " + missing.join(", "));
}

}  // namespace palpate::gui

// The main window's files: opening, the recordings that are open, drag and drop.
#include <QComboBox>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QMenu>
#include <QMimeData>
#include <QTime>
#include <algorithm>

#include <palpate/core/time.h>

#include "gui/inspect/inspect_panel.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/open/start_page.h"
#include "gui/shell/main_window.h"
#include "gui/space/hand_panel.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/widgets/message_banner.h"

namespace palpate::gui {
namespace {

constexpr const char* kMainWindowFilesLastFolder = "recent/folder";

std::vector<std::filesystem::path> localFiles(const QMimeData& data) {
  std::vector<std::filesystem::path> files;
  for (const QUrl& url : data.urls())
    if (url.isLocalFile()) files.emplace_back(url.toLocalFile().toStdString());
  return files;
}

QString mainWindowFilesNameOf(const OpenedRecording& recording) {
  return QString::fromStdString(recording.path.filename().string());
}

QString nameAndDate(const OpenedRecording& recording) {
  if (recording.profile.numFrames() == 0) return mainWindowFilesNameOf(recording) + " · empty";
  const std::string date = utcText(recording.profile.frameTimeUs(0)).substr(0, 10);
  return mainWindowFilesNameOf(recording) + " · " + QString::fromStdString(date);
}

}  // namespace

void MainWindow::askAndOpen() {
  std::vector<std::filesystem::path> files;
  for (const QString& path : askForRecordings()) files.emplace_back(path.toStdString());
  if (files.empty()) return;
  settings_.setValue(kMainWindowFilesLastFolder,
                     QFileInfo(QString::fromStdString(files[0].string())).path());
  openFiles(files);
}

void MainWindow::openFiles(const std::vector<std::filesystem::path>& files) {
  if (files.empty()) return;
  banner_->dismiss();
  shownOfBatch_ = false;
  demoAsked_ = false;
  for (const auto& file : files) opener_.open(file);
}

void MainWindow::openDemoRecording() {
  openFiles({demoPath_});
  demoAsked_ = true;
}

void MainWindow::fillRecentMenu() {
  QMenu* menu = menus_->recent;
  menu->clear();
  bool anyMissing = false;
  for (const QString& path : recent_.paths()) {
    const bool exists = RecentFiles::exists(path);
    anyMissing = anyMissing || !exists;
    QString text = QFileInfo(path).fileName();
    text.replace('&', "&&");
    QAction* entry = menu->addAction(exists ? text : text + " (missing)");
    entry->setToolTip(path);
    entry->setEnabled(exists);
    connect(entry, &QAction::triggered, this, [this, path] { openFiles({path.toStdString()}); });
  }
  if (recent_.paths().isEmpty()) menu->addAction("nothing yet")->setEnabled(false);
  menu->addSeparator();
  QAction* forget = menu->addAction("Forget missing files");
  forget->setEnabled(anyMissing);
  connect(forget, &QAction::triggered, &recent_, &RecentFiles::removeMissing);
  QAction* clear = menu->addAction("Forget all");
  clear->setEnabled(!recent_.paths().isEmpty());
  connect(clear, &QAction::triggered, &recent_, &RecentFiles::clear);
}

void MainWindow::addRecording(const OpenedRecordingPtr& recording) {
  const bool isDemo = recording->path == demoPath_;
  if (!isDemo) recent_.add(QString::fromStdString(recording->path.string()));
  // A file that is open already is replaced by what it holds now.
  const auto same = std::find_if(recordings_.begin(), recordings_.end(), [&](const auto& other) {
    return other->path == recording->path;
  });
  if (same == recordings_.end()) {
    recordings_.push_back(recording);
  } else {
    editors_.erase(same->get());
    grasps_.erase(same->get());
    leftAt_.erase((*same)->path);
    if (current_ == *same) current_.reset();
    *same = recording;
  }
  listRecordings();
  if (shownOfBatch_) {
    enableActions();
    return;
  }
  shownOfBatch_ = true;
  showRecording(recording);
  if (!isDemo || !demoAsked_) return;
  if (!playback_.loop()) {
    playback_.setLoop(true);
    loopIsOfDemo_ = true;
  }
  playback_.play();
}

void MainWindow::listRecordings() {
  QComboBox* box = menus_->recordings;
  box->clear();
  for (const auto& each : recordings_) box->addItem(nameAndDate(*each));
  const auto at = std::find(recordings_.begin(), recordings_.end(), current_);
  if (at != recordings_.end()) box->setCurrentIndex(static_cast<int>(at - recordings_.begin()));
  menus_->recordingsAction->setVisible(!recordings_.empty());
  listCompared();
}

void MainWindow::showRecording(const OpenedRecordingPtr& recording) {
  if (recording == current_ && current_ && !liveShown_) return;
  if (!liveShown_) noteWhereWeAre();
  current_ = recording;
  shown_ = recording;
  // What is connected goes on, and comes back when no recording is left.
  const bool live = !recording && live_.source();
  liveShown_ = false;
  if (!recording) showCompare(false);
  setPlace(recording ? Place::kRecording : live ? Place::kLive : Place::kStart);
  timeline_->setRecording(recording);
  timeline_->setBefore(nullptr);
  if (recording)
    signalTree_->setSource(recording->profile.hand(),
                           recording->profile.numAngles() > 0,
                           recording->profile.numTemperatures() > 0);
  if (!live) {
    matrices_->setRecording(recording);
    handPanel_->setRecording(recording);
    inspect_->setRecording(recording);
  }
  if (recording)
    playback_.setProfile(recording->profile, recording->timingNow().gaps);
  else
    playback_.setProfile(std::nullopt);
  setWindowTitle(recording ? mainWindowFilesNameOf(*recording) + " – Palpate" : QString("Palpate"));
  listRecordings();
  if (recording) {
    goBackToWhereWeWere();
    if (recording->profile.numFrames() == 0)
      banner_->showMessage(mainWindowFilesNameOf(*recording) +
                           ": holds no frame; there is nothing to show");
  }
  if (live) showLive();
  if (!live) filterNewSource();
  showCurves();
  showEvents();
  enableActions();
  updateStatus();
  if (recording) emit recordingShown();
}

void MainWindow::showNeighbour(int step) {
  const auto at = std::find(recordings_.begin(), recordings_.end(), current_);
  if (at == recordings_.end()) return;
  const auto count = static_cast<std::ptrdiff_t>(recordings_.size());
  const auto next = (at - recordings_.begin() + step + count) % count;
  showRecording(recordings_[static_cast<std::size_t>(next)]);
}

void MainWindow::closeCurrent() {
  const auto at = std::find(recordings_.begin(), recordings_.end(), current_);
  if (at == recordings_.end() || !settleUnsaved({current_})) return;
  editors_.erase(current_.get());
  grasps_.erase(current_.get());
  const auto index = at - recordings_.begin();
  leftAt_.erase(current_->path);
  current_.reset();
  recordings_.erase(at);
  const auto next = std::min(index, static_cast<std::ptrdiff_t>(recordings_.size()) - 1);
  showRecording(next < 0 ? nullptr : recordings_[static_cast<std::size_t>(next)]);
}

QString MainWindow::pictureName() const {
  if (liveShown_) return "live_" + QTime::currentTime().toString("HHmmss");
  return QString("%1_frame_%2")
      .arg(QFileInfo(mainWindowFilesNameOf(*current_)).completeBaseName())
      .arg(playback_.frame(), 5, 10, QChar('0'));
}

bool MainWindow::somethingIsShown() const {
  return matrices_->hand() && !matrices_->frame().values.empty() &&
         (liveShown_ || playback_.hasFrames());
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (localFiles(*event->mimeData()).empty()) return;
  event->acceptProposedAction();
  startPage_->setDragging(true);
}

void MainWindow::dragLeaveEvent(QDragLeaveEvent*) { startPage_->setDragging(false); }

void MainWindow::dropEvent(QDropEvent* event) {
  startPage_->setDragging(false);
  const auto files = localFiles(*event->mimeData());
  if (files.empty()) return;
  event->acceptProposedAction();
  openFiles(files);
}

}  // namespace palpate::gui

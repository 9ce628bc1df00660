// The main window's files: opening, the recordings that are open, drag and drop.
#include <QComboBox>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QMenu>
#include <QMimeData>
#include <QTime>
#include <algorithm>
#include <utility>

#include <palpate/core/time.h>

#include "gui/compare/compare_panel.h"
#include "gui/inspect/inspect_panel.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/open/start_page.h"
#include "gui/shell/main_window.h"
#include "gui/space/hand_panel.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/widgets/message_banner.h"

namespace palpate::gui {
namespace {

std::vector<std::filesystem::path> localFiles(const QMimeData& data) {
  std::vector<std::filesystem::path> files;
  for (const QUrl& url : data.urls())
    if (url.isLocalFile()) files.emplace_back(url.toLocalFile().toStdString());
  return files;
}

QString nameAndDate(const OpenedRecording& recording) {
  if (recording.profile.numFrames() == 0) return fileNameOf(recording) + " · empty";
  const std::string date = utcText(recording.profile.frameTimeUs(0)).substr(0, 10);
  return fileNameOf(recording) + " · " + QString::fromStdString(date);
}

}  // namespace

void MainWindow::askAndOpen(OpenRequest::Then then) {
  std::vector<std::filesystem::path> files;
  for (const QString& path : askForRecordings()) files.emplace_back(path.toStdString());
  if (files.empty()) return;
  recent_.setLastFolder(QFileInfo(QString::fromStdString(files[0].string())).path());
  openFiles(files, then);
}

void MainWindow::openFiles(const std::vector<std::filesystem::path>& files,
                           OpenRequest::Then then) {
  if (files.empty()) return;
  banner_->dismiss();
  recordings_.open({files, then});
}

void MainWindow::openDemoRecording() { openFiles({demoPath_}, OpenRequest::Then::kPlayInLoop); }

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

void MainWindow::forget(const OpenedRecordingPtr& recording) {
  editors_.erase(recording.get());
  grasps_.erase(recording.get());
  discarded_.erase(recording.get());
  leftAt_.erase(recording->path);
}

void MainWindow::addRecording(const OpenedRecordingPtr& recording, const OpenArrival& arrival) {
  using Then = OpenRequest::Then;
  if (recording->path != demoPath_) recent_.add(QString::fromStdString(recording->path.string()));
  // A file that is open already is replaced by what it holds now; behind what is live it isn't shown for that.
  const bool wasCurrent = arrival.replaced && arrival.replaced == current_;
  if (arrival.replaced) forget(arrival.replaced);
  if (wasCurrent) current_ = liveShown_ ? recording : nullptr;
  listRecordings();
  const bool compared = arrival.then == Then::kCompare;
  const bool first = arrival.place == 0 && arrival.then != Then::kList;
  const bool shown =
      (wasCurrent && !liveShown_) || (first && (!compared || !current_ || liveShown_));
  if (shown)
    showRecording(recording);
  else
    enableActions();
  // With nothing to compare yet the first is A, and the next is compared with it.
  if (compared && shown && recordings().size() > 1) showCompare(true);
  if (compared && !shown && (first || (arrival.place == 1 && !compareShown()))) {
    compare_->setB(recording);
    showCompare(true);
  }
  if (arrival.then != Then::kPlayInLoop || !first) return;
  if (!playback_.loop()) {
    playback_.setLoop(true);
    loopIsOfDemo_ = true;
  }
  playback_.play();
}

void MainWindow::listRecordings() {
  QComboBox* box = menus_->recordings;
  box->clear();
  const auto& all = recordings_.all();
  for (const auto& each : all) box->addItem(nameAndDate(*each));
  const auto at = std::find(all.begin(), all.end(), current_);
  if (at != all.end()) box->setCurrentIndex(static_cast<int>(at - all.begin()));
  menus_->recordingsAction->setVisible(!all.empty());
  compare_->setRecordings(all, current_);
}

void MainWindow::showRecording(const OpenedRecordingPtr& recording) {
  if (recording == current_ && current_ && !liveShown_) return;
  if (!liveShown_) noteWhereWeAre();
  // Until the new one is everywhere nobody asks it for the old one's frame.
  playback_.setProfile(std::nullopt);
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
    setPictureOld({});  // what was held, or is no more connected
    matrices_->setRecording(recording);
    handPanel_->setRecording(recording);
    inspect_->setRecording(recording);
  }
  if (recording)
    playback_.setProfile(recording->profile, recording->timingNow().gaps);
  else
    playback_.setProfile(std::nullopt);
  setWindowTitle(recording ? fileNameOf(*recording) + " – Palpate" : QString("Palpate"));
  listRecordings();
  if (recording) {
    goBackToWhereWeWere();
    if (recording->profile.numFrames() == 0)
      banner_->showMessage(fileNameOf(*recording) + ": holds no frame; there is nothing to show");
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
  if (const OpenedRecordingPtr next = recordings_.neighbour(current_, step)) showRecording(next);
}

void MainWindow::closeCurrent() {
  if (!current_ || !settleUnsaved({current_})) return;
  const OpenedRecordingPtr closed = std::exchange(current_, nullptr);
  forget(closed);
  showRecording(recordings_.close(closed));
}

QString MainWindow::pictureName() const {
  if (liveShown_) return "live_" + QTime::currentTime().toString("HHmmss");
  return QString("%1_frame_%2")
      .arg(QFileInfo(fileNameOf(*current_)).completeBaseName())
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

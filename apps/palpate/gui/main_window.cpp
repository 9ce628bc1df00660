#include "gui/main_window.h"

#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMimeData>
#include <QStatusBar>
#include <QVBoxLayout>
#include <algorithm>

#include <palpate/core/time.h>
#include <palpate/recording/recording.h>

#include "gui/dock.h"
#include "gui/hand_dock.h"
#include "gui/inspect_panel.h"
#include "gui/matrices_panel.h"
#include "gui/message_banner.h"
#include "gui/opening_strip.h"
#include "gui/picture_export.h"
#include "gui/playback_bar.h"
#include "gui/start_page.h"
#include "gui/status_strip.h"
#include "gui/timeline_chart.h"
#include "gui/timeline_header.h"

namespace palpate::gui {
namespace {

constexpr const char* kDemoFile = "demo_grasps.dsa";
constexpr const char* kLastFolder = "recent/folder";
constexpr const char* kLastPictureFolder = "recent/picture_folder";
constexpr QSize kSmallestWindow(900, 600);
constexpr QSize kUsualWindow(1440, 900);

std::vector<std::filesystem::path> localFiles(const QMimeData& data) {
  std::vector<std::filesystem::path> files;
  for (const QUrl& url : data.urls())
    if (url.isLocalFile()) files.emplace_back(url.toLocalFile().toStdString());
  return files;
}

QString nameOf(const OpenedRecording& recording) {
  return QString::fromStdString(recording.path.filename().string());
}

QString nameAndDate(const OpenedRecording& recording) {
  if (recording.profile.numFrames() == 0) return nameOf(recording) + " · empty";
  const std::string date = utcText(recording.profile.frameTimeUs(0)).substr(0, 10);
  return nameOf(recording) + " · " + QString::fromStdString(date);
}

}  // namespace

MainWindow::MainWindow(const WindowSurroundings& surroundings)
    : settings_(surroundings.settingsPath, QSettings::IniFormat),
      recent_(settings_),
      view_(loadViewSettings(settings_)),
      actions_(this),
      playback_(surroundings.clock ? *surroundings.clock : systemClock()),
      opener_(surroundings.read ? surroundings.read
                                : RecordingOpener::Read([](const std::filesystem::path& path,
                                                           const Progress& progress) {
                                    return openRecording(path, progress);
                                  })) {
  setWindowTitle("Palpate");
  setMinimumSize(kSmallestWindow);
  setAcceptDrops(true);
  setDockOptions(AnimatedDocks | AllowNestedDocks | AllowTabbedDocks);
  buildParts(surroundings.dataFolder);
  buildDocks();
  connectOpening();
  connectFileActions();
  connectPlayback();
  connectViewActions();
  connectChoices();

  askForRecordings = [this] {
    return QFileDialog::getOpenFileNames(this,
                                         "Open recordings",
                                         settings_.value(kLastFolder).toString(),
                                         "Recordings (*.dsa *.palpate *.xml);;All files (*)");
  };
  askForPicture = [this](const QString& suggestion) {
    return QFileDialog::getSaveFileName(this,
                                        "Export picture",
                                        suggestion,
                                        "PNG picture (*.png);;SVG drawing (*.svg);;PDF (*.pdf)");
  };
  resize(kUsualWindow);
  restoreGeometry(settings_.value("window/geometry").toByteArray());
  layout_ = settings_.value("window/layout").toByteArray();
  playback_.setSpeed(view_.speed);
  playback_.setLoop(view_.loop);
  playback_.setSkipGaps(view_.skipGaps);
  applyTheme();
  applyView();
  setPlaceForRecording(false);
  listRecordings();
}

MainWindow::~MainWindow() { workers_.waitForDone(); }

void MainWindow::buildParts(const std::filesystem::path& dataFolder) {
  std::error_code ignored;
  demoPath_ = dataFolder / kDemoFile;
  const bool withDemo = std::filesystem::exists(demoPath_, ignored);
  actions_.openDemo->setVisible(withDemo);
  actions_.openDemo->setEnabled(withDemo);

  auto* page = new QWidget(this);
  banner_ = new MessageBanner(page);
  opening_ = new OpeningStrip(page);
  startPage_ = new StartPage(recent_, withDemo, page);
  matrices_ = new MatricesPanel(actions_.interpolated, actions_.values, page);
  playbackBar_ = new PlaybackBar(playback_, page);
  auto* work = new QWidget(page);
  auto* column = new QVBoxLayout(work);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(matrices_, 1);
  column->addWidget(playbackBar_);
  stack_ = new QStackedWidget(page);
  stack_->addWidget(startPage_);
  stack_->addWidget(work);
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(banner_);
  layout->addWidget(opening_);
  layout->addWidget(stack_, 1);
  setCentralWidget(page);

  status_ = new StatusStrip(this);
  status_->setObjectName("statusStrip");
  statusBar()->setSizeGripEnabled(false);
  statusBar()->setContentsMargins(0, 0, 0, 0);
  statusBar()->addWidget(status_, 1);
}

void MainWindow::buildDocks() {
  inspect_ = new InspectPanel(this);
  timelineHeader_ = new TimelineHeader(this);
  timeline_ = new TimelineChart(this);
  auto* inspectDock = new Dock("Inspect", inspect_, nullptr, this);
  auto* timelineDock = new Dock("Timeline", timeline_, timelineHeader_, this);
  hand_ = new HandDock(settings_, this);
  handDock_ = new Dock("Hand", hand_, nullptr, this);
  docks_ = {inspectDock, timelineDock, handDock_};
  setCorner(Qt::BottomRightCorner, Qt::BottomDockWidgetArea);
  setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  addDockWidget(Qt::RightDockWidgetArea, inspectDock);
  addDockWidget(Qt::BottomDockWidgetArea, timelineDock);
  addDockWidget(Qt::RightDockWidgetArea, handDock_);
  tabifyDockWidget(inspectDock, handDock_);
  QList<QAction*> toggles;
  for (Dock* dock : docks_) {
    QAction* toggle = dock->toggleViewAction();
    setSection(*toggle, "View");
    addAction(toggle);
    toggles.append(toggle);
  }
  inspectDock->toggleViewAction()->setShortcut(QKeySequence("Ctrl+I"));
  timelineDock->toggleViewAction()->setShortcut(QKeySequence("Ctrl+L"));
  handDock_->toggleViewAction()->setShortcut(QKeySequence("Ctrl+H"));
  menus_ = std::make_unique<WindowMenus>(*this, actions_, toggles);
}

void MainWindow::connectOpening() {
  connect(&opener_, &RecordingOpener::started, opening_, &OpeningStrip::begin);
  connect(&opener_, &RecordingOpener::started, this, &MainWindow::updateStatus);
  connect(&opener_, &RecordingOpener::progressed, opening_, &OpeningStrip::setProgress);
  connect(&opener_, &RecordingOpener::finished, opening_, &OpeningStrip::end);
  connect(&opener_, &RecordingOpener::finished, this, &MainWindow::updateStatus);
  connect(&opener_, &RecordingOpener::opened, this, &MainWindow::addRecording);
  connect(&opener_, &RecordingOpener::failed, this, [this](const QString&, const QString& message) {
    banner_->showMessage(message);
  });
  connect(&opener_, &RecordingOpener::cancelled, this, [this](const QString& path) {
    flash("opening " + QFileInfo(path).fileName() + " was cancelled");
  });
  connect(opening_, &OpeningStrip::cancelRequested, &opener_, &RecordingOpener::cancel);
  connect(startPage_, &StartPage::openAsked, this, &MainWindow::askAndOpen);
  connect(startPage_, &StartPage::demoAsked, this, &MainWindow::openDemo);
  connect(startPage_, &StartPage::fileChosen, this, [this](const QString& path) {
    openFiles({path.toStdString()});
  });
}

void MainWindow::connectFileActions() {
  connect(actions_.open, &QAction::triggered, this, &MainWindow::askAndOpen);
  connect(actions_.openDemo, &QAction::triggered, this, &MainWindow::openDemo);
  connect(actions_.nextRecording, &QAction::triggered, this, [this] { showNeighbour(1); });
  connect(actions_.previousRecording, &QAction::triggered, this, [this] { showNeighbour(-1); });
  connect(actions_.closeRecording, &QAction::triggered, this, &MainWindow::closeCurrent);
  connect(actions_.exportPicture, &QAction::triggered, this, &MainWindow::exportPicture);
  connect(actions_.copyPicture, &QAction::triggered, this, &MainWindow::copyPicture);
  connect(actions_.quit, &QAction::triggered, this, &QWidget::close);
  connect(menus_->recent, &QMenu::aboutToShow, this, &MainWindow::fillRecentMenu);
  connect(menus_->recordings, &QComboBox::activated, this, [this](int index) {
    showRecording(recordings_.at(static_cast<std::size_t>(index)));
  });
  fillRecentMenu();
}

void MainWindow::askAndOpen() {
  std::vector<std::filesystem::path> files;
  for (const QString& path : askForRecordings()) files.emplace_back(path.toStdString());
  if (files.empty()) return;
  settings_.setValue(kLastFolder, QFileInfo(QString::fromStdString(files[0].string())).path());
  openFiles(files);
}

void MainWindow::openFiles(const std::vector<std::filesystem::path>& files) {
  if (files.empty()) return;
  banner_->dismiss();
  shownOfBatch_ = false;
  demoAsked_ = false;
  for (const auto& file : files) opener_.open(file);
}

void MainWindow::openDemo() {
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
    lastFrames_.push_back(0);
  } else {
    lastFrames_[static_cast<std::size_t>(same - recordings_.begin())] = 0;
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
}

void MainWindow::showRecording(const OpenedRecordingPtr& recording) {
  if (recording == current_ && current_) return;
  const auto before = std::find(recordings_.begin(), recordings_.end(), current_);
  if (before != recordings_.end())
    lastFrames_[static_cast<std::size_t>(before - recordings_.begin())] = playback_.frame();
  current_ = recording;
  setPlaceForRecording(recording != nullptr);
  matrices_->setRecording(recording);
  timeline_->setRecording(recording);
  inspect_->setRecording(recording);
  playback_.setProfile(recording ? std::optional(recording->profile) : std::nullopt);
  setWindowTitle(recording ? nameOf(*recording) + " – Palpate" : QString("Palpate"));
  listRecordings();
  if (recording) {
    const auto at = std::find(recordings_.begin(), recordings_.end(), recording);
    playback_.seekFrame(lastFrames_[static_cast<std::size_t>(at - recordings_.begin())]);
    if (recording->profile.numFrames() == 0)
      banner_->showMessage(nameOf(*recording) + ": holds no frame; there is nothing to show");
  }
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
  if (at == recordings_.end()) return;
  const auto index = at - recordings_.begin();
  current_.reset();
  recordings_.erase(at);
  lastFrames_.erase(lastFrames_.begin() + index);
  const auto next = std::min(index, static_cast<std::ptrdiff_t>(recordings_.size()) - 1);
  showRecording(next < 0 ? nullptr : recordings_[static_cast<std::size_t>(next)]);
}

void MainWindow::exportPicture() {
  if (!current_ || !playback_.hasFrames()) return;
  const QString stem = QFileInfo(nameOf(*current_)).completeBaseName();
  const QString name =
      QString("%1_frame_%2.png").arg(stem).arg(playback_.frame(), 5, 10, QChar('0'));
  const QString folder = settings_.value(kLastPictureFolder).toString();
  QString path = askForPicture(folder.isEmpty() ? name : folder + "/" + name);
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += ".png";
  settings_.setValue(kLastPictureFolder, QFileInfo(path).path());
  // Drawn and written beside the window, which goes on playing.
  workers_.start([this,
                  path,
                  frame = matrices_->frame(),
                  hand = current_->profile.hand(),
                  options = exportOptions()] {
    QString failure;
    try {
      // The dialog has asked whether an existing file may be replaced.
      writeMatricesPicture(path.toStdString(), frame, hand, options, Overwrite::kReplace);
    } catch (const std::exception& error) {
      failure = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(
        this,
        [this, path, failure] {
          if (!failure.isEmpty()) return banner_->showMessage(failure);
          flash("written: " + path);
          emit pictureWritten(path);
        },
        Qt::QueuedConnection);
  });
}

void MainWindow::copyPicture() {
  if (!current_ || !playback_.hasFrames()) return;
  QApplication::clipboard()->setImage(
      matricesImage(matrices_->frame(), current_->profile.hand(), exportOptions()));
  flash("picture copied");
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

// The main window's Library and Log: they stay as they are, whatever else is shown.
#include <QFileInfo>
#include <QStandardPaths>
#include <algorithm>

#include "gui/compare/compare_panel.h"
#include "gui/library/library_panel.h"
#include "gui/library/log_panel.h"
#include "gui/link/link_panel.h"
#include "gui/shell/main_window.h"
#include "gui/widgets/dock.h"
#include "gui/widgets/message_banner.h"

namespace palpate::gui {
namespace {

constexpr const char* kLibraryShown = "library/shown";
constexpr const char* kLogShown = "log/shown";

// Beside settings that aren't the user's own ones (a test's, a screenshot's) nothing is kept among the user's files.
QString cacheFolderFor(const QSettings& settings) {
  if (QFileInfo(settings.fileName()) == QFileInfo(settingsPath()))
    return QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation) + "/palpate";
  return QFileInfo(settings.fileName()).absolutePath() + "/cache";
}

QString openedText(const OpenedRecording& recording) {
  const std::size_t frames = recording.profile.numFrames();
  QString text = "opened " + QString::fromStdString(recording.path.string()) + ": " +
                 QString::number(frames) + (frames == 1 ? " frame" : " frames");
  if (frames > 1) text += ", " + lengthText(recording.timing.durationS);
  return text;
}

}  // namespace

void MainWindow::buildLibrary() {
  library_ = new LibraryPanel(settings_, cacheFolderFor(settings_), catalogRecordings, this);
  libraryDock_ = new Dock("Library", library_, nullptr, this);
  log_ = new LogPanel(activity_, this);
  logDock_ = new Dock("Log", log_, nullptr, this);
  docks_ += {libraryDock_, logDock_};
  libraryDock_->toggleViewAction()->setShortcut(QKeySequence("Ctrl+Shift+L"));
  logDock_->toggleViewAction()->setShortcut(QKeySequence("Ctrl+Shift+J"));
}

void MainWindow::placeLibrary() {
  addDockWidget(Qt::LeftDockWidgetArea, libraryDock_);
  tabifyDockWidget(inspectDock_, logDock_);
  for (Dock* dock : {libraryDock_, logDock_}) {
    dock->setFloating(false);
    dock->hide();
  }
}

bool MainWindow::staysEverywhere(const Dock* dock) const {
  return dock == libraryDock_ || dock == logDock_;
}

void MainWindow::connectLibrary() {
  connect(library_, &LibraryPanel::openAsked, this, [this](const QStringList& paths) {
    std::vector<std::filesystem::path> files;
    for (const QString& path : paths) files.emplace_back(path.toStdString());
    openFiles(files);
  });
  connect(library_, &LibraryPanel::compareAsked, this, [this](const QString& path) {
    compareWith(path.toStdString());
  });
  library_->comparable = [this] { return current_ && !liveShown_; };
  connect(library_, &LibraryPanel::said, this, [this](const QString& message) {
    activity_.add(LogLine::Severity::kWarning, message);
  });
  connect(&live_, &LiveController::recordingEnded, this, [this](const RecordingReport& report) {
    if (library_->folder().isEmpty() && !report.paths.empty())
      library_->setFolder(QString::fromStdString(report.paths.front().parent_path().string()));
  });
  // Asked for by its key, the next thing is to search.
  connect(libraryDock_->toggleViewAction(), &QAction::triggered, this, [this](bool shown) {
    if (shown) library_->startSearch();
  });

  connect(banner_, &MessageBanner::said, this, [this](const QString& message) {
    activity_.add(LogLine::Severity::kError, message);
  });
  connect(link_, &LinkPanel::logged, this, [this](const QString& line) {
    // What the banner has just said isn't said again.
    const int last = activity_.rowCount() - 1;
    if (last >= 0 && line.contains(activity_.line(last).text)) return;
    activity_.add(line.startsWith("alarm") ? LogLine::Severity::kWarning : LogLine::Severity::kInfo,
                  line);
  });
  connect(&opener_, &RecordingOpener::opened, this, [this](const OpenedRecordingPtr& recording) {
    activity_.add(LogLine::Severity::kInfo, openedText(*recording));
    for (const std::string& warning : recording->profile.info().warnings)
      activity_.add(LogLine::Severity::kWarning,
                    QString::fromStdString(recording->path.filename().string() + ": " + warning));
  });
  connect(log_, &LogPanel::saved, this, [this](const QString& path) { flash("written: " + path); });
  connect(log_, &LogPanel::failed, banner_, &MessageBanner::showMessage);
}

// What is shown stays A.
void MainWindow::compareWith(const std::filesystem::path& path) {
  const OpenedRecordingPtr known = recordings_.at(path);
  if (!known) return openFiles({path}, OpenRequest::Then::kCompare);
  compare_->setB(known);
  showCompare(true);
}

void MainWindow::showLibraryAgain() {
  libraryDock_->setVisible(settings_.value(kLibraryShown, false).toBool());
  logDock_->setVisible(settings_.value(kLogShown, false).toBool());
}

void MainWindow::rememberLibrary() {
  settings_.setValue(kLibraryShown, !libraryDock_->isHidden());
  settings_.setValue(kLogShown, !logDock_->isHidden());
}

}  // namespace palpate::gui

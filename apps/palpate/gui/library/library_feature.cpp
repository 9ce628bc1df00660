#include "gui/library/library_feature.h"

#include <QFileInfo>
#include <QStandardPaths>

#include "gui/library/library_panel.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

// Beside settings that aren't the user's own ones (a test's, a screenshot's) nothing is kept among
// the user's files.
QString cacheFolderFor(const QSettings& settings) {
  if (QFileInfo(settings.fileName()) == QFileInfo(settingsPath()))
    return QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation) + "/palpate";
  return QFileInfo(settings.fileName()).absolutePath() + "/cache";
}

}  // namespace

LibraryFeature::LibraryFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      panel_(new LibraryPanel(
          windowState.settings, cacheFolderFor(windowState.settings), catalogRecordings, window)) {
  dock_ = new Dock("Library", panel_, nullptr, window);
  connect(panel_, &LibraryPanel::openRequested, this, [&windowState](const QStringList& paths) {
    std::vector<std::filesystem::path> files;
    for (const QString& path : paths) files.emplace_back(path.toStdString());
    windowState.open(files);
  });
  connect(panel_, &LibraryPanel::compareAsked, this, [this](const QString& path) {
    compareWith(path.toStdString());
  });
  panel_->comparable = [&windowState] { return windowState.displayed.isRecording(); };
  connect(panel_, &LibraryPanel::said, this, [&windowState](const QString& message) {
    windowState.log.add(LogLine::Severity::kWarning, message);
  });
  connect(
      &windowState.live,
      &LiveController::recordingEnded,
      this,
      [this](const RecordingReport& report) {
        if (panel_->folder().isEmpty() && !report.paths.empty())
          panel_->setFolder(QString::fromStdString(report.paths.front().parent_path().string()));
      });
  followTheme(panel_);
}

// What is shown stays A.
void LibraryFeature::compareWith(const std::filesystem::path& path) {
  if (const OpenedRecordingPtr known = state().recordings.at(path))
    state().comparison.with(known);
  else
    state().open({path}, OpenRequest::Then::kCompare);
}

std::vector<DockSpec> LibraryFeature::docks() {
  return {{.dock = dock_,
           .key = QKeySequence("Ctrl+Shift+L"),
           .area = Qt::LeftDockWidgetArea,
           .liveArea = Qt::LeftDockWidgetArea,
           .everywhere = true,
           // Asked for by its key, the next thing is to search.
           .asked = [this] { panel_->startSearch(); }}};
}

}  // namespace palpate::gui

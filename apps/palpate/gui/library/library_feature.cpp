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

LibraryFeature::LibraryFeature(Bench& bench, QWidget* window)
    : Feature(bench, window),
      panel_(new LibraryPanel(
          bench.settings, cacheFolderFor(bench.settings), catalogRecordings, window)) {
  dock_ = new Dock("Library", panel_, nullptr, window);
  connect(panel_, &LibraryPanel::openAsked, this, [&bench](const QStringList& paths) {
    std::vector<std::filesystem::path> files;
    for (const QString& path : paths) files.emplace_back(path.toStdString());
    bench.open(files);
  });
  connect(panel_, &LibraryPanel::compareAsked, this, [this](const QString& path) {
    compareWith(path.toStdString());
  });
  panel_->comparable = [&bench] { return bench.subject.isRecording(); };
  connect(panel_, &LibraryPanel::said, this, [&bench](const QString& message) {
    bench.log.add(LogLine::Severity::kWarning, message);
  });
  connect(
      &bench.live, &LiveController::recordingEnded, this, [this](const RecordingReport& report) {
        if (panel_->folder().isEmpty() && !report.paths.empty())
          panel_->setFolder(QString::fromStdString(report.paths.front().parent_path().string()));
      });
  followTheme(panel_);
}

// What is shown stays A.
void LibraryFeature::compareWith(const std::filesystem::path& path) {
  if (const OpenedRecordingPtr known = bench().recordings.at(path))
    bench().comparing.with(known);
  else
    bench().open({path}, OpenRequest::Then::kCompare);
}

std::vector<DockOffer> LibraryFeature::docks() {
  return {{.dock = dock_,
           .key = QKeySequence("Ctrl+Shift+L"),
           .area = Qt::LeftDockWidgetArea,
           .liveArea = Qt::LeftDockWidgetArea,
           .everywhere = true,
           // Asked for by its key, the next thing is to search.
           .asked = [this] { panel_->startSearch(); }}};
}

}  // namespace palpate::gui

#include "gui/library/library_feature.h"

#include "gui/appearance/window_settings.h"
#include "gui/library/library_panel.h"
#include "gui/widgets/content_scroll.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {

LibraryFeature::LibraryFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      panel_(new LibraryPanel(windowState.settings,
                              windowState.ask,
                              cacheFolder(windowState.settings),
                              catalogRecordings,
                              window)) {
  dock_ = new Dock("Library", new ContentScroll(panel_, kMinDockContent), nullptr, window);
  connect(panel_, &LibraryPanel::openRequested, this, [&windowState](const QStringList& paths) {
    std::vector<std::filesystem::path> files;
    for (const QString& path : paths) files.emplace_back(path.toStdString());
    windowState.openOrShow(files);
  });
  connect(panel_, &LibraryPanel::compareRequested, this, [this](const QString& path) {
    compareWith(path.toStdString());
  });
  windowState.showLibrary = [this](const QString& folder) {
    if (!folder.isEmpty()) panel_->setFolder(folder);
    emit dockRequested(dock_);
    if (!folder.isEmpty()) panel_->startSearch();
  };
  windowState.chosenRecordings = [this] {
    return panel_->isVisible() ? panel_->chosen() : QStringList();
  };
  connect(panel_, &LibraryPanel::batchRequested, this, [&windowState] {
    windowState.actions.at("batch")->trigger();
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
  connect(&windowState.displayed, &DisplayedSource::shown, this, [this] {
    const OpenedRecordingPtr recording = state().displayed.recorded();
    if (recording && !recording->damage.empty())
      panel_->setDamaged(recording->path, recording->damage);
  });
}

// The shown recording stays A.
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
           // When the user opens the dock by its key, the search gets the keyboard focus.
           .asked = [this] { panel_->startSearch(); }}};
}

}  // namespace palpate::gui

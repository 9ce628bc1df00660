#include "gui/library/log_feature.h"

#include "gui/library/library_panel.h"
#include "gui/library/log_panel.h"
#include "gui/widgets/content_scroll.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

QString openedText(const OpenedRecording& recording) {
  const std::size_t frames = recording.profile.numFrames();
  QString text = "opened " + QString::fromStdString(recording.path.string()) + ": " +
                 QString::number(frames) + (frames == 1 ? " frame" : " frames");
  if (frames > 1) text += ", " + lengthText(recording.timing.durationS);
  return text;
}

}  // namespace

LogFeature::LogFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window), panel_(new LogPanel(windowState.log, windowState.ask, window)) {
  dock_ = new Dock("Log", new ContentScroll(panel_, kMinDockContent), nullptr, window);
  connect(&windowState.opener,
          &RecordingOpener::opened,
          this,
          [&windowState](const OpenedRecordingPtr& recording) {
            windowState.log.add(LogLine::Severity::kInfo, openedText(*recording));
            for (const std::string& warning : recording->profile.info().warnings)
              windowState.log.add(LogLine::Severity::kWarning,
                                  fileNameOf(*recording) + ": " + QString::fromStdString(warning));
          });
  connect(panel_, &LogPanel::saved, this, [&windowState](const QString& path) {
    windowState.messages.flash("written: " + path);
  });
  connect(panel_, &LogPanel::failed, &windowState.messages, &Messages::fail);
}

std::vector<DockSpec> LogFeature::docks() {
  return {{.dock = dock_, .key = QKeySequence("Ctrl+Shift+J"), .tab = 4, .everywhere = true}};
}

}  // namespace palpate::gui

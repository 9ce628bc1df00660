#include "gui/library/log_feature.h"

#include "gui/library/library_panel.h"
#include "gui/library/log_panel.h"
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

LogFeature::LogFeature(Bench& bench, QWidget* window)
    : Feature(bench, window), panel_(new LogPanel(bench.log, window)) {
  dock_ = new Dock("Log", panel_, nullptr, window);
  connect(
      &bench.opener, &RecordingOpener::opened, this, [&bench](const OpenedRecordingPtr& recording) {
        bench.log.add(LogLine::Severity::kInfo, openedText(*recording));
        for (const std::string& warning : recording->profile.info().warnings)
          bench.log.add(LogLine::Severity::kWarning,
                        fileNameOf(*recording) + ": " + QString::fromStdString(warning));
      });
  connect(panel_, &LogPanel::saved, this, [&bench](const QString& path) {
    bench.messages.flash("written: " + path);
  });
  connect(panel_, &LogPanel::failed, &bench.messages, &Messages::fail);
  followTheme(panel_);
}

std::vector<DockOffer> LogFeature::docks() {
  return {{.dock = dock_, .key = QKeySequence("Ctrl+Shift+J"), .tab = 4, .everywhere = true}};
}

}  // namespace palpate::gui

#include "gui/export/export_feature.h"

#include "gui/appearance/icons.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {

ExportActions::ExportActions(ActionRegistry& book) {
  exportPicture = book.make("exportPicture", "File", "&Export…", {key("Ctrl+E")});
  exportAgain = book.make("exportAgain", "File", "Export as &last time", {key("Ctrl+Shift+E")});
  copyPicture = book.make("copyPicture", "File", "Cop&y", {key("Ctrl+C")});
  copyPicture->setToolTip("Copy the view that was clicked last (Ctrl+C)");
  copyTable = book.make("copyTable", "File", "Copy &table");
  exportPicture->setIconText(" Export");
  exportPicture->setIcon(makeIcon(IconShape::kExport));
}

ExportFeature::ExportFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      actions_(windowState.actions),
      exportController_(windowState.settings, windowState.ask, window),
      strip_(new OpeningStrip(window, "Exporting", "exporting")) {
  exportController_.source = [&windowState] {
    const OpenedRecordingPtr recording = windowState.displayed.unfilteredRecording();
    return recording ? QString::fromStdString(recording->path.string()) : QString();
  };
  ExportActions& actions = actions_;
  on(actions.exportPicture, [this] { exportController_.exportNow(); });
  on(actions.exportAgain, [this] { exportController_.repeatLast(); });
  on(actions.copyPicture, [this] { exportController_.copyPicture(); });
  on(actions.copyTable, [this] { exportController_.copyTable(); });
  connect(&exportController_, &ExportController::started, strip_, &OpeningStrip::begin);
  connect(&exportController_, &ExportController::progressed, strip_, &OpeningStrip::setProgress);
  connect(&exportController_, &ExportController::finished, strip_, &OpeningStrip::end);
  connect(strip_, &OpeningStrip::cancelRequested, &exportController_, &ExportController::cancel);
  connect(&exportController_, &ExportController::said, &windowState.messages, &Messages::flash);
  connect(&exportController_, &ExportController::failed, &windowState.messages, &Messages::fail);
  windowState.actionEnabler.add(
      {actions.exportPicture, actions.exportAgain, actions.copyPicture, actions.copyTable},
      [&windowState] { return windowState.currentFrame.hasFrame(); });
  windowState.escapeHandler.add(EscapeHandler::Order::kExport, [this] {
    if (!exportController_.busy()) return false;
    exportController_.cancel();
    return true;
  });
}

std::vector<BannerSpec> ExportFeature::strips() { return {{BannerSpec::Order::kExport, strip_}}; }

}  // namespace palpate::gui

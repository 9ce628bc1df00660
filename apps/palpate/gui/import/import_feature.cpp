#include "gui/import/import_feature.h"

#include <QFileInfo>
#include <memory>

#include <palpate/model/hand_file.h>

#include "gui/import/import_dialog.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {

ImportFeature::ImportFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      import_(windowState.actions.make("importTable", "File", "&Import…", {})),
      strip_(new OpeningStrip(window, "Importing", "importing")) {
  import_->setToolTip("Import a table of another program: CSV, NumPy, HDF5");
  on(import_, [this] { askAndImport(); });
  connect(&job_, &BackgroundJob::started, strip_, &OpeningStrip::begin);
  connect(&job_, &BackgroundJob::progressed, strip_, &OpeningStrip::setProgress);
  connect(&job_, &BackgroundJob::finished, strip_, &OpeningStrip::end);
  connect(strip_, &OpeningStrip::cancelRequested, &job_, &BackgroundJob::cancel);
  connect(&job_, &BackgroundJob::failed, &windowState.messages, &Messages::fail);
  connect(&job_, &BackgroundJob::cancelled, this, [&windowState](const QString& text) {
    windowState.messages.flash(QFileInfo(text).fileName() + ": cancelled, nothing was written");
  });
  windowState.escapeHandler.add(EscapeHandler::Order::kWork, [this] {
    if (!job_.busy()) return false;
    job_.cancel();
    return true;
  });
}

void ImportFeature::askAndImport() {
  ImportDialog dialog(
      state().settings, handFolders(state().environment.dataFolder), state().ask, window());
  if (dialog.exec() != QDialog::Accepted) return;
  saveImportRequest(dialog.request(), state().settings);
  importNow(dialog.request());
}

void ImportFeature::importNow(const ImportRequest& request) {
  state().messages.dismissFailures();
  auto report = std::make_shared<ImportReport>();
  job_.start(
      request.data,
      [request, report, folders = handFolders(state().environment.dataFolder)](
          const Progress& progress) { *report = runImport(request, folders, progress); },
      [this, report, request] {
        const QString text = textOf(*report, request.out);
        // What was lost stays in the banner until it is closed.
        if (report->isPartial())
          state().messages.fail(text);
        else
          state().messages.flash(text);
        state().recordings.open({{request.out.toStdString()}, OpenRequest::Then::kShowFirst});
      });
}

std::vector<BannerSpec> ImportFeature::strips() { return {{BannerSpec::Order::kWork, strip_}}; }

}  // namespace palpate::gui

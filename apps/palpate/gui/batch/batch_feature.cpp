#include "gui/batch/batch_feature.h"

#include "gui/batch/batch_dialog.h"
#include "gui/batch/batch_fields.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {
namespace {

// Topic of the message that stays until the failures were seen.
constexpr const char* kBatchFailures = "batch failures";

}  // namespace

BatchFeature::BatchFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      batch_(windowState.actions.make("batch", "Analysis", "&Batch…")),
      strip_(new OpeningStrip(window, "Running a", "batch")) {
  batch_->setToolTip("Make a file from each of many recordings: convert, signals, slip, features");
  on(batch_, [this] { showDialog(); });
  connect(&controller_, &BatchController::started, strip_, [this] {
    strip_->begin("batch");
    state().messages.withdraw(kBatchFailures);
  });
  connect(&controller_, &BatchController::progressed, strip_, [this](const BatchStatus& status) {
    strip_->setProgress(status.fraction);
  });
  connect(&controller_, &BatchController::finished, strip_, &OpeningStrip::end);
  connect(strip_, &OpeningStrip::cancelRequested, &controller_, &BatchController::cancel);
  connect(&controller_, &BatchController::failed, &windowState.messages, &Messages::fail);
  connect(&controller_, &BatchController::ended, this, &BatchFeature::report);
  windowState.escapeHandler.add(EscapeHandler::Order::kWork, [this] {
    if (!controller_.busy()) return false;
    controller_.cancel();
    return true;
  });
  windowState.batchRunning = [this] { return controller_.busy(); };
}

BatchFeature::~BatchFeature() {
  state().batchRunning = nullptr;
  // The dialog refers to the controller.
  delete dialog_;
}

void BatchFeature::showDialog() {
  if (!dialog_) {
    dialog_ = new BatchDialog(state().settings, controller_, state().ask, window());
    dialog_->fields().windowFilters = [this] {
      return state().activeFilters.on() ? state().activeFilters.text() : QString();
    };
  }
  if (!controller_.busy()) begin();
  state().messages.withdraw(kBatchFailures);
  dialog_->show();
  dialog_->raise();
  dialog_->activateWindow();
}

// Begins with what is chosen in the Library; with a list that nobody made, of one recording or
// none, also with the recording that is shown.
void BatchFeature::begin() {
  const QStringList chosen = state().chosenRecordings ? state().chosenRecordings() : QStringList();
  const bool isShort = dialog_->choices().paths.size() <= 1;
  if (chosen.size() > 1 || (isShort && !chosen.isEmpty())) {
    dialog_->setPaths(chosen);
  } else if (const OpenedRecordingPtr shown = state().displayed.recorded(); isShort && shown) {
    dialog_->setPaths({QString::fromStdString(shown->path.string())});
  }
}

void BatchFeature::report() {
  const BatchReport& report = controller_.outcome()->report;
  const QString text =
      (report.cancelled ? "Batch cancelled: " : "Batch: ") + countsText(report.status);
  // What failed stays in the banner until it is closed, unless the dialog shows it.
  const bool bad = report.status.failed + report.status.inPart > 0;
  if (bad && !(dialog_ && dialog_->isVisible()))
    state().messages.failAbout(kBatchFailures, text + "; Analysis > Batch has what failed and why");
  else
    state().messages.flash(text);
}

void BatchFeature::remember() {
  controller_.cancel();
  if (!dialog_) return;
  saveBatchChoices(dialog_->choices(), state().settings);
  dialog_->hide();
}

std::vector<BannerSpec> BatchFeature::strips() { return {{BannerSpec::Order::kWork, strip_}}; }

}  // namespace palpate::gui

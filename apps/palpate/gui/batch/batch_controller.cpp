#include "gui/batch/batch_controller.h"

#include <vector>

namespace palpate::gui {
namespace {

BatchOutcome outcomeOf(const BatchChoices& choices,
                       const Progress& progress,
                       const std::function<void(const BatchStatus&)>& show) {
  BatchOutcome outcome;
  std::vector<std::filesystem::path> paths;
  for (const QString& path : choices.paths) paths.emplace_back(path.toStdString());
  const BatchTask task = taskOf(choices);
  // The folders are read again: they may have changed since the dialog showed the names.
  outcome.plan = planBatch(
      paths, templateOf(choices), [&](double) { return progress(0.0); }, SameResults::kRefuse);
  outcome.report =
      runBatch(outcome.plan, task, optionsOf(choices), {}, [&](const BatchStatus& status) {
        show(status);
        return progress(status.fraction);
      });
  return outcome;
}

}  // namespace

BatchController::BatchController(QObject* parent) : QObject(parent) {
  connect(&job_, &BackgroundJob::failed, this, &BatchController::failed);
  connect(&job_, &BackgroundJob::finished, this, &BatchController::finished);
}

void BatchController::start(const BatchChoices& choices) {
  if (busy()) return;
  auto made = std::make_shared<BatchOutcome>();
  job_.start(
      "batch",
      [this, made, choices](const Progress& progress) {
        *made = outcomeOf(choices, progress, [this](const BatchStatus& status) {
          QMetaObject::invokeMethod(
              this, [this, status] { emit progressed(status); }, Qt::QueuedConnection);
        });
      },
      [this, made] {
        outcome_ = made;
        emit ended();
      });
  emit started();
}

}  // namespace palpate::gui

// Runs the batch of the Batch dialog in the background, one at a time.
#pragma once

#include <QObject>
#include <QString>
#include <memory>

#include <palpate/batch/batch_plan.h>
#include <palpate/batch/batch_run.h>

#include "gui/batch/batch_choices.h"
#include "gui/source/background_job.h"

namespace palpate::gui {

// A batch that has ended.
struct BatchOutcome {
  BatchPlan plan = {};
  BatchReport report = {};
};

class BatchController : public QObject {
  Q_OBJECT
 public:
  explicit BatchController(QObject* parent = nullptr);

  // Does nothing while a batch runs.
  void start(const BatchChoices& choices);
  // What is finished stays; nothing is left half-written.
  void cancel() { job_.cancel(); }
  bool busy() const noexcept { return job_.busy(); }
  // The last batch that has ended; null: none.
  const std::shared_ptr<const BatchOutcome>& outcome() const noexcept { return outcome_; }

 signals:
  void started();
  // Ten times a second.
  void progressed(const palpate::BatchStatus& status);
  // All was tried, or the batch was cancelled: outcome() is new.
  void ended();
  // Nothing was done; why, in one line.
  void failed(const QString& message);
  // After each of both, and after a cancellation before the first recording.
  void finished();

 private:
  std::shared_ptr<const BatchOutcome> outcome_;
  BackgroundJob job_;
};

}  // namespace palpate::gui

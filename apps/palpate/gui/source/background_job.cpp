#include "gui/source/background_job.h"

#include <QCoreApplication>
#include <QEventLoop>
#include <QPointer>

#include <palpate/core/error.h>

namespace palpate::gui {

BackgroundJob::BackgroundJob(Leaving leaving, QObject* parent)
    : QObject(parent), leaving_(leaving) {
  connect(&thread_, &Abandonable::progressed, this, &BackgroundJob::progressed);
  connect(&thread_, &Abandonable::finished, this, &BackgroundJob::startNext);
}

BackgroundJob::~BackgroundJob() {
  thread_.stop();
  if (leaving_ == Leaving::kWaits) thread_.join();
}

void BackgroundJob::start(const QString& text, Work work, std::function<void()> done) {
  waiting_.push_back({text, std::move(work), std::move(done)});
  if (!busy_) startNext();
}

void BackgroundJob::cancel() {
  waiting_.clear();
  cancelAsked_ = true;
  thread_.stop();
}

void BackgroundJob::settle() {
  const QPointer<BackgroundJob> self(this);
  while (self && busy_) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
}

void BackgroundJob::startNext() {
  if (waiting_.empty()) {
    busy_ = false;
    emit finished();
    return;
  }
  Waiting now = std::move(waiting_.front());
  waiting_.pop_front();
  busy_ = true;
  cancelAsked_ = false;
  emit started(now.text);
  thread_.start(
      [this, now](const Abandonable::Asker& asker) -> Abandonable::Take {
        try {
          now.work(asker.progress);
        } catch (const Cancelled&) {
          return [this, text = now.text] { emit cancelled(text); };
        }
        return now.done;
      },
      [this, text = now.text](const QString& message) {
        if (cancelAsked_)
          emit cancelled(text);
        else
          emit failed(message, text);
      });
}

}  // namespace palpate::gui

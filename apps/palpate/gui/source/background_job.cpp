#include "gui/source/background_job.h"

#include <palpate/core/error.h>

namespace palpate::gui {
namespace {

constexpr double kBackgroundJobSmallestNews = 0.01;

}  // namespace

BackgroundJob::~BackgroundJob() {
  waiting_.clear();
  cancelAsked_ = true;
  if (worker_.joinable()) worker_.join();
}

void BackgroundJob::start(const QString& text, Work work, std::function<void()> done) {
  waiting_.push_back({text, std::move(work), std::move(done)});
  if (!busy_) startNext();
}

void BackgroundJob::cancel() {
  waiting_.clear();
  cancelAsked_ = true;
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
  // The thread has already reported its result: joining it takes no time.
  if (worker_.joinable()) worker_.join();
  worker_ = std::jthread([this, now = std::move(now)] {
    double reported = -1.0;
    const Progress progress = [&](double fraction) {
      if (fraction - reported >= kBackgroundJobSmallestNews || fraction < reported) {
        reported = fraction;
        QMetaObject::invokeMethod(
            this, [this, fraction] { emit progressed(fraction); }, Qt::QueuedConnection);
      }
      return !cancelAsked_;
    };
    try {
      now.work(progress);
      conclude([done = now.done] {
        if (done) done();
      });
    } catch (const Cancelled&) {
      conclude([this, text = now.text] { emit cancelled(text); });
    } catch (const std::exception& error) {
      conclude([this, text = now.text, message = QString::fromUtf8(error.what())] {
        if (cancelAsked_)
          emit cancelled(text);
        else
          emit failed(message);
      });
    }
  });
}

void BackgroundJob::conclude(std::function<void()> report) {
  QMetaObject::invokeMethod(
      this,
      [this, report = std::move(report)] {
        report();
        startNext();
      },
      Qt::QueuedConnection);
}

}  // namespace palpate::gui

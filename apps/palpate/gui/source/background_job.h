// Runs long work in a background thread, one job at a time, with progress and cancel. All signals
// and callbacks come in the thread of this object.
#pragma once

#include <QObject>
#include <QString>
#include <atomic>
#include <deque>
#include <functional>
#include <thread>

#include <palpate/core/progress.h>

namespace palpate::gui {

class BackgroundJob : public QObject {
  Q_OBJECT
 public:
  // The work runs in a thread of its own; an exception that it throws is reported by failed() or,
  // for Cancelled and where the job was cancelled, by cancelled().
  using Work = std::function<void(const Progress&)>;

  explicit BackgroundJob(QObject* parent = nullptr) : QObject(parent) {}
  // Cancels all jobs and waits for the running one.
  ~BackgroundJob() override;

  // Starts the work once the running and the waiting jobs have ended. `done` is called when it has
  // succeeded.
  void start(const QString& text, Work work, std::function<void()> done = {});
  // Cancels the running job and all that wait.
  void cancel();
  bool busy() const noexcept { return busy_; }

 signals:
  void started(const QString& text);
  void progressed(double fraction);
  void failed(const QString& message);
  void cancelled(const QString& text);
  // No job runs or waits any more.
  void finished();

 private:
  struct Waiting {
    QString text;
    Work work;
    std::function<void()> done;
  };
  void startNext();
  void conclude(std::function<void()> report);

  std::deque<Waiting> waiting_;
  std::atomic<bool> cancelAsked_ = false;
  bool busy_ = false;
  std::jthread worker_;
};

}  // namespace palpate::gui

// Runs long work in a background thread, one job at a time, with progress and cancel. All signals
// and callbacks come in the thread of this object.
#pragma once

#include <deque>

#include "gui/source/abandonable.h"

namespace palpate::gui {

class BackgroundJob : public QObject {
  Q_OBJECT
 public:
  // The work runs in a thread of its own; an exception that it throws is reported by failed() or,
  // for Cancelled and where the job was cancelled, by cancelled().
  using Work = std::function<void(const Progress&)>;
  // Whether the destructor waits for the running job, which it cancels in any case. Where it
  // doesn't, works must use nothing but what they hold themselves.
  enum class Leaving { kWaits, kAtOnce };

  explicit BackgroundJob(QObject* parent = nullptr) : BackgroundJob(Leaving::kWaits, parent) {}
  explicit BackgroundJob(Leaving leaving, QObject* parent = nullptr);
  ~BackgroundJob() override;

  // Starts the work once the running and the waiting jobs have ended. `done` is called when it has
  // succeeded.
  void start(const QString& text, Work work, std::function<void()> done = {});
  // Cancels the running job and all that wait.
  void cancel();
  bool busy() const noexcept { return busy_; }
  // Waits until no job runs or waits, with events.
  void settle();

 signals:
  void started(const QString& text);
  void progressed(double fraction);
  void failed(const QString& message, const QString& text);
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

  const Leaving leaving_;
  std::deque<Waiting> waiting_;
  bool cancelAsked_ = false;
  bool busy_ = false;
  Abandonable thread_;
};

}  // namespace palpate::gui

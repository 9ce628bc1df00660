// Long work beside the window, one piece at a time: with progress, cancel, and a word at its end in
// this object's thread.
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
  // Runs in a thread of its own; what it throws is told, Cancelled too.
  using Work = std::function<void(const Progress&)>;

  explicit BackgroundJob(QObject* parent = nullptr) : QObject(parent) {}
  // Cancels and waits.
  ~BackgroundJob() override;

  // `done` is called once it has ended well. Waits for what is at work.
  void start(const QString& text, Work work, std::function<void()> done = {});
  // Gives up what is at work, and what waits.
  void cancel();
  bool busy() const noexcept { return busy_; }

 signals:
  void started(const QString& text);
  void progressed(double fraction);
  void failed(const QString& message);
  void cancelled(const QString& text);
  void finished();  // nothing is at work any more

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

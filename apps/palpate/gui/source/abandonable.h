// Work in a thread that nobody waits for: the window stays awake while it is long, and can be left
// while a network folder or a device doesn't answer.
#pragma once

#include <QObject>
#include <QString>
#include <chrono>
#include <functional>
#include <memory>

#include <palpate/core/progress.h>

namespace palpate::gui {

class Abandonable : public QObject {
  Q_OBJECT
 public:
  // Takes over what was found; called in the thread of this object.
  using Take = std::function<void()>;
  // Who waits for a work; for its thread, while it runs.
  struct Asker {
    // False once nobody waits, or stop() was called.
    Progress progress;
    // Has something taken over before the end. Nothing is, once nobody waits.
    std::function<void(Take)> tell;
  };
  // Runs in a thread of its own, perhaps longer than this object lives: it must use nothing but
  // what it holds itself. What it returns may be empty.
  using Work = std::function<Take(const Asker&)>;
  using Failed = std::function<void(const QString& message)>;

  explicit Abandonable(QObject* parent = nullptr) : QObject(parent) {}
  // Waits for nothing; no answer comes any more.
  ~Abandonable() override;

  // Starts in place of what is running, at once; the answer to that never comes. Either the Take
  // that `work` returns is called, or `failed` with the message of its exception, or of why it
  // can't be begun; neither before start() returns.
  void start(Work work, Failed failed);
  // No answer comes any more. It isn't busy then.
  void abandon();
  // Asks the work to end soon, by its progress; its answer is still waited for.
  void stop();
  // Waits, without events, until the thread has ended, unless it was abandoned. Its answer is under
  // way then.
  void join();
  bool busy() const noexcept { return thread_ != nullptr; }
  // Waits for the answer, with events.
  void settle();

  // Does something of which nobody here wants an answer, in a thread as above; returns whether that
  // could be begun.
  static bool run(std::function<void()> work);
  // Waits until all these threads have ended, at most so long; returns whether they have. Call it
  // at the end of the program: what they use mustn't be destroyed under them.
  static bool awaitThreads(std::chrono::milliseconds longest);

 signals:
  // It wasn't busy before.
  void started();
  // In steps of a hundredth.
  void progressed(double fraction);
  // The answer came, or nobody waits for one any more.
  void finished();

 private:
  struct Thread;
  void answer(const std::shared_ptr<Thread>& thread, const Take& take);
  void drop();

  std::shared_ptr<Thread> thread_;
};

}  // namespace palpate::gui

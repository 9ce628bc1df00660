#include "gui/source/abandonable.h"

#include <QCoreApplication>
#include <QEventLoop>
#include <QPointer>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include <palpate/core/error.h>

namespace palpate::gui {
namespace {

// More at once means that their files don't answer.
constexpr std::size_t kMaxAbandonable = 256;
constexpr double kAbandonableSmallestNews = 0.01;

struct AbandonableThreads {
  std::mutex mutex;
  std::condition_variable ended;
  std::size_t running = 0;
};

// Never destroyed: threads may run longer than the statics live.
AbandonableThreads& abandonableThreads() {
  static auto* const all = new AbandonableThreads;
  return *all;
}

// Runs `work`, then `last` with the lock of all; returns why it can't, or nothing.
QString inCountedThread(std::function<void()> work, std::function<void()> last = {}) {
  AbandonableThreads& all = abandonableThreads();
  {
    const std::lock_guard guard(all.mutex);
    if (all.running >= kMaxAbandonable)
      return "nothing is read: too many files that don't answer are being read";
    ++all.running;
  }
  const auto end = [&all, last = std::move(last)] {
    const std::lock_guard guard(all.mutex);
    --all.running;
    if (last) last();
    all.ended.notify_all();
  };
  try {
    std::thread([end, work = std::move(work)]() mutable {
      work();
      work = {};
      end();
    }).detach();
  } catch (const std::system_error& error) {
    end();
    return QString("nothing is read: no thread can be made: ") + error.what();
  }
  return {};
}

}  // namespace

struct Abandonable::Thread {
  std::mutex mutex;
  Abandonable* asker = nullptr;  // null: nobody waits for the answer any more
  std::atomic<bool> isWanted = true;
  bool isOver = false;  // the thread; under the lock of all threads
};

Abandonable::~Abandonable() {
  blockSignals(true);
  drop();
}

void Abandonable::start(Work work, Failed failed) {
  const bool begins = !busy();
  drop();
  auto thread = std::make_shared<Thread>();
  thread->asker = this;
  thread_ = thread;
  // Calls `what` in the thread of the asker, if it still waits then.
  const auto post = [thread](std::function<void(Abandonable&)> what) {
    const std::lock_guard<std::mutex> guard(thread->mutex);
    if (Abandonable* asker = thread->asker)
      QMetaObject::invokeMethod(
          asker,
          [asker, thread, what = std::move(what)] {
            if (thread == asker->thread_) what(*asker);
          },
          Qt::QueuedConnection);
  };
  const auto answerWith = [thread, post](Take take) {
    post([thread, take = std::move(take)](Abandonable& asker) { asker.answer(thread, take); });
  };
  const QString refused = inCountedThread(
      [thread, post, answerWith, work, failed]() mutable {
        double reported = -1.0;
        const Asker asker{
            [&](double fraction) {
              if (fraction - reported >= kAbandonableSmallestNews || fraction < reported) {
                reported = fraction;
                post([fraction](Abandonable& owner) { emit owner.progressed(fraction); });
              }
              return thread->isWanted.load();
            },
            [&](Take take) { post([take = std::move(take)](Abandonable&) { take(); }); }};
        Take take;
        try {
          take = work(asker);
        } catch (const std::exception& error) {
          take = [failed, message = QString::fromUtf8(error.what())] { failed(message); };
        }
        work = {};
        answerWith(std::move(take));
        failed = {};
      },
      [thread] { thread->isOver = true; });
  if (!refused.isEmpty()) {
    thread->isOver = true;
    answerWith([failed, refused] { failed(refused); });
  }
  if (begins) emit started();
}

void Abandonable::answer(const std::shared_ptr<Thread>& thread, const Take& take) {
  if (thread != thread_) return;
  thread_.reset();
  // What takes it may destroy this object, or start the next.
  const QPointer<Abandonable> self(this);
  if (take) take();
  if (self && !busy()) emit finished();
}

void Abandonable::drop() {
  if (!thread_) return;
  thread_->isWanted = false;
  const std::lock_guard<std::mutex> guard(thread_->mutex);
  thread_->asker = nullptr;
}

void Abandonable::abandon() {
  if (!busy()) return;
  drop();
  thread_.reset();
  emit finished();
}

void Abandonable::stop() {
  if (thread_) thread_->isWanted = false;
}

void Abandonable::join() {
  if (!thread_) return;
  AbandonableThreads& all = abandonableThreads();
  std::unique_lock guard(all.mutex);
  all.ended.wait(guard, [&] { return thread_->isOver; });
}

void Abandonable::settle() {
  const QPointer<Abandonable> self(this);
  while (self && busy()) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
}

bool Abandonable::run(std::function<void()> work) {
  return inCountedThread(std::move(work)).isEmpty();
}

bool Abandonable::awaitThreads(std::chrono::milliseconds longest) {
  AbandonableThreads& all = abandonableThreads();
  std::unique_lock guard(all.mutex);
  return all.ended.wait_for(guard, longest, [&] { return all.running == 0; });
}

}  // namespace palpate::gui

#include "palpate/core/parallel_work.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "palpate/core/error.h"

namespace palpate {
namespace {

constexpr std::chrono::milliseconds kReportEvery{50};

// What the threads of one call share.
class SharedWork {
 public:
  SharedWork(std::size_t count, const std::function<void(std::size_t)>& work)
      : count_(count), work_(work) {}

  // Takes pieces until there is none; `afterEach` says whether to go on.
  template <typename AfterEach>
  void take(const AfterEach& afterEach) {
    while (!stopped_) {
      const std::size_t index = next_.fetch_add(1);
      if (index >= count_) break;
      try {
        work_(index);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_ || index < failedIndex_) {
          failure_ = std::current_exception();
          failedIndex_ = index;
        }
        stopped_ = true;
      }
      ++done_;
      if (!afterEach()) stopped_ = true;
    }
  }

  void stop() { stopped_ = true; }
  double fraction() const { return static_cast<double>(done_) / static_cast<double>(count_); }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::size_t count_;
  const std::function<void(std::size_t)>& work_;
  std::atomic<std::size_t> next_ = 0, done_ = 0;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::size_t failedIndex_ = 0;
};

}  // namespace

void forEachParallel(std::size_t count,
                     const std::function<void(std::size_t)>& work,
                     std::size_t threads,
                     const Progress& progress) {
  if (count == 0) return;
  if (threads == 0) threads = std::max<std::size_t>(1, std::thread::hardware_concurrency());
  threads = std::min(threads, count);
  SharedWork shared(count, work);
  bool cancelled = false;
  const auto report = [&] {
    if (progress && !cancelled) cancelled = !progress(shared.fraction());
    return !cancelled;
  };
  if (threads == 1) {
    if (report()) shared.take(report);
  } else {
    std::mutex mutex;
    std::condition_variable ended;
    std::size_t running = threads;
    std::vector<std::jthread> pool;
    pool.reserve(threads);
    for (std::size_t i = 0; i < threads; ++i)
      pool.emplace_back([&] {
        shared.take([] { return true; });
        const std::lock_guard lock(mutex);
        --running;
        ended.notify_one();
      });
    std::unique_lock lock(mutex);
    while (!ended.wait_for(lock, kReportEvery, [&] { return running == 0; })) {
      lock.unlock();
      if (!report()) shared.stop();
      lock.lock();
    }
  }
  shared.rethrow();
  if (cancelled) throw Cancelled();
}

}  // namespace palpate

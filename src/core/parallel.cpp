#include "palpate/core/parallel.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "palpate/core/error.h"

namespace palpate {
namespace {

class Pieces {
 public:
  Pieces(std::size_t count, const std::function<void(std::size_t)>& work)
      : count_(count), work_(work) {}

  // Works until no piece is left; called in each thread.
  void run() {
    std::unique_lock lock(mutex_);
    while (!stopped_ && next_ < count_) {
      const std::size_t index = next_++;
      lock.unlock();
      std::exception_ptr error;
      try {
        work_(index);
      } catch (...) {
        error = std::current_exception();
      }
      lock.lock();
      if (error && (!error_ || index < errorIndex_)) {
        error_ = error;
        errorIndex_ = index;
      }
      if (error) stopped_ = true;
      ++done_;
      changed_.notify_one();
    }
    ++ended_;
    changed_.notify_one();
  }

  // Waits in the caller's thread until `threads` threads have ended, and reports progress.
  void await(std::size_t threads, const Progress& progress) {
    std::unique_lock lock(mutex_);
    std::size_t reported = 0;
    while (ended_ < threads) {
      if (progress && !stopped_ && done_ != reported) {
        reported = done_;
        lock.unlock();
        const bool goOn = progress(static_cast<double>(reported) / static_cast<double>(count_));
        lock.lock();
        if (!goOn) stopped_ = cancelled_ = true;
        continue;
      }
      changed_.wait(lock, [&] { return ended_ == threads || (progress && done_ != reported); });
      if (stopped_) reported = done_;
    }
  }

  void stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
    if (cancelled_) throw Cancelled();
  }

 private:
  std::size_t count_;
  const std::function<void(std::size_t)>& work_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t next_ = 0, done_ = 0, ended_ = 0;
  bool stopped_ = false, cancelled_ = false;
  std::exception_ptr error_;
  std::size_t errorIndex_ = 0;
};

}  // namespace

void forEachInParallel(std::size_t count,
                       const std::function<void(std::size_t)>& work,
                       const Progress& progress,
                       std::size_t threads) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  threads = std::min(threads, count);
  if (count == 0) return;
  if (progress && !progress(0.0)) throw Cancelled();
  Pieces pieces(count, work);
  {
    std::vector<std::jthread> workers;
    try {
      while (workers.size() < threads) workers.emplace_back([&pieces] { pieces.run(); });
      pieces.await(threads, progress);
    } catch (...) {  // a progress callback threw, or a thread could not be started
      pieces.stop();
      throw;
    }
  }
  pieces.rethrow();
}

}  // namespace palpate

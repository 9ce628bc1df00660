// Reads the recordings of a list several at a time, and hands the results out in order: what comes
// out is the same as if they were read one after the other.
//
// Only files of at most kReadAheadBytes are read ahead, so that the results that wait stay small.
// A larger one is read when its turn comes, its blocks on several threads.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <palpate/core/progress.h>

namespace palpate {

inline constexpr std::uintmax_t kReadAheadBytes = 64u << 10;

// How many threads read ahead: as many as the machine runs at once, at most 8. None on a machine
// with one core and for less than two files.
std::size_t readAheadThreads(std::size_t numFiles) noexcept;
bool isReadAhead(const std::filesystem::path& file) noexcept;
// The number of threads (as DsaReadOptions::threads) to read one of several files with that are
// read at the same time: 1 for a small one.
std::size_t threadsBesideOthers(const std::filesystem::path& file) noexcept;

// Not thread-safe. The destructor cancels what was not taken, and ends the threads.
template <typename Result>
class ReadAhead {
 public:
  // `threads`: as DsaReadOptions::threads. Called from several threads at once.
  using Read = std::function<Result(
      const std::filesystem::path& file, const Progress& progress, std::size_t threads)>;

  // `files` must outlive the object.
  ReadAhead(const std::vector<std::filesystem::path>& files, Read read)
      : ReadAhead(files, std::move(read), readAheadThreads(files.size())) {}
  ReadAhead(const std::vector<std::filesystem::path>& files, Read read, std::size_t threads)
      : files_(files), read_(std::move(read)), maxAhead_(threads + 6) {
    try {
      while (threads_.size() < threads) threads_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
      // Fewer threads, or none: take() reads by itself.
    }
  }
  ~ReadAhead() {
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
    }
    hasSpace_.notify_all();
  }
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  // The result of the next file; throws what reading it threw, or Cancelled when `progress` returns
  // false. Call it once for each file.
  Result take(const Progress& progress) {
    if (progress && !progress(0.0)) throw Cancelled();
    std::unique_lock lock(mutex_);
    const std::size_t index = taken_++;
    const auto begun = begun_.find(index);
    const bool readHere = begun == begun_.end();
    if (readHere && begins_ <= index) begins_ = index + 1;
    hasSpace_.notify_one();
    if (readHere) {
      lock.unlock();
      return read_(
          files_[index], progress, threads_.empty() ? 0 : threadsBesideOthers(files_[index]));
    }
    isDone_.wait(lock, [&] { return begun->second.done; });
    Outcome outcome = std::move(begun->second);
    begun_.erase(begun);
    lock.unlock();
    if (outcome.failure) std::rethrow_exception(outcome.failure);
    if (progress && !progress(1.0)) throw Cancelled();
    return std::move(*outcome.result);
  }

 private:
  struct Outcome {
    std::optional<Result> result;
    std::exception_ptr failure;
    bool done = false;
  };

  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      hasSpace_.wait(lock, [&] {
        return stopped_ || begins_ >= files_.size() || begins_ < taken_ + maxAhead_;
      });
      if (stopped_ || begins_ >= files_.size()) return;
      const std::size_t index = begins_++;
      if (!isReadAhead(files_[index])) continue;
      Outcome& outcome = begun_[index];  // stays where it is while others come and go
      lock.unlock();
      std::optional<Result> result;
      std::exception_ptr failure;
      try {
        result = read_(
            files_[index], [this](double) { return !isStopped(); }, 1);
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      outcome = {std::move(result), failure, true};
      if (index + 1 == taken_) isDone_.notify_one();
    }
  }
  bool isStopped() {
    const std::lock_guard lock(mutex_);
    return stopped_;
  }

  const std::vector<std::filesystem::path>& files_;
  const Read read_;
  const std::size_t maxAhead_;  // files begun or read, but not taken

  std::mutex mutex_;                      // guards all below
  std::condition_variable hasSpace_;      // for the threads
  std::condition_variable isDone_;        // for take()
  std::map<std::size_t, Outcome> begun_;  // by index
  std::size_t begins_ = 0;                // the next file that a thread begins
  std::size_t taken_ = 0;
  bool stopped_ = false;

  std::vector<std::jthread> threads_;
};

}  // namespace palpate

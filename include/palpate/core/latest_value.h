// A mailbox between threads for the latest value: a writer puts its newest value, and a reader
// takes it when it has time. The reader gets each value at most once; values that were overwritten
// before that are counted as skipped.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

namespace palpate {

// Counts since construction.
struct LatestValueStats {
  std::uint64_t puts = 0;
  std::uint64_t takes = 0;
  std::uint64_t skipped = 0;  // overwritten before they were taken
};

template <typename T>
class LatestValue {
 public:
  // Replaces the value; never waits for the reader.
  void put(T value) {
    std::lock_guard lock(mutex_);
    ++stats_.puts;
    if (value_) ++stats_.skipped;
    value_ = std::move(value);
  }
  // Returns the newest value since the last take(); empty when there is none.
  std::optional<T> take() {
    std::lock_guard lock(mutex_);
    if (value_) ++stats_.takes;
    return std::exchange(value_, std::nullopt);
  }
  LatestValueStats stats() const {
    std::lock_guard lock(mutex_);
    return stats_;
  }

 private:
  mutable std::mutex mutex_;
  std::optional<T> value_;
  LatestValueStats stats_;
};

}  // namespace palpate

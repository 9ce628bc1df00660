// The latest-value mailbox: a writer leaves its newest value, a reader takes it when it has time.
// The reader sees each value at most once; values overwritten unseen are counted as skipped.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

namespace palpate {

struct LatestValueStats {
  std::uint64_t puts = 0;
  std::uint64_t takes = 0;
  std::uint64_t skipped = 0;  // overwritten before anybody took them
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
  // The newest value since the last take(), or nothing.
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

// A bounded, blocking queue that counts its items. Threads exchange data only through it and
// through the latest-value mailbox (latest_value.h). It never grows, and it counts every item that
// it refuses.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace palpate {

// Counts since construction; pushes = pops + items in the queue.
struct QueueStats {
  std::uint64_t pushes = 0;  // items accepted
  std::uint64_t pops = 0;    // items handed out
  // Items that tryPush refused because the queue was full.
  std::uint64_t overflows = 0;
  std::size_t highWater = 0;  // largest number of items in the queue
};

// Any number of threads may push and pop.
template <typename T>
class BoundedQueue {
 public:
  // Throws std::invalid_argument when capacity is 0.
  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {
    if (capacity == 0) throw std::invalid_argument("BoundedQueue: capacity must be at least 1");
    ring_.resize(capacity);
  }

  // Waits until there is room. Returns false when the queue was closed; `item` is then not added.
  bool push(T item) {
    std::unique_lock lock(mutex_);
    notFull_.wait(lock, [&] { return closed_ || size_ < capacity_; });
    if (closed_) return false;
    put(std::move(item));
    return true;
  }

  // Never waits. Returns false when the queue is full (counted as an overflow) or closed; `item` is
  // then not added.
  bool tryPush(T item) {
    std::lock_guard lock(mutex_);
    if (closed_) return false;
    if (size_ == capacity_) {
      ++stats_.overflows;
      return false;
    }
    put(std::move(item));
    return true;
  }

  // Waits for an item. Returns nothing when the queue was closed and is empty.
  std::optional<T> pop() {
    std::unique_lock lock(mutex_);
    notEmpty_.wait(lock, [&] { return closed_ || size_ > 0; });
    return take();
  }

  // Never waits. Returns nothing when the queue is empty.
  std::optional<T> tryPop() {
    std::lock_guard lock(mutex_);
    return take();
  }

  // Ends all waiting: from now on pushes fail; pops still return the items in the queue.
  void close() {
    std::lock_guard lock(mutex_);
    closed_ = true;
    notFull_.notify_all();
    notEmpty_.notify_all();
  }

  std::size_t size() const {
    std::lock_guard lock(mutex_);
    return size_;
  }
  QueueStats stats() const {
    std::lock_guard lock(mutex_);
    return stats_;
  }

 private:
  void put(T&& item) {
    ring_[(first_ + size_) % capacity_] = std::move(item);
    ++size_;
    ++stats_.pushes;
    if (size_ > stats_.highWater) stats_.highWater = size_;
    notEmpty_.notify_one();
  }
  std::optional<T> take() {
    if (size_ == 0) return std::nullopt;
    std::optional<T> item = std::exchange(ring_[first_], std::nullopt);
    first_ = (first_ + 1) % capacity_;
    --size_;
    ++stats_.pops;
    notFull_.notify_one();
    return item;
  }

  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable notFull_;
  std::condition_variable notEmpty_;
  std::vector<std::optional<T>> ring_;
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  bool closed_ = false;
  QueueStats stats_;
};

}  // namespace palpate

// A bounded, blocking, counting queue: one of the only two ways to hand things from thread to
// thread (the other is the latest-value mailbox). It never grows and never drops silently: what
// didn't fit is counted.
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

// Counts since construction; pushes = pops + the items still inside.
struct QueueStats {
  std::uint64_t pushes = 0;     // items accepted
  std::uint64_t pops = 0;       // items handed out
  std::uint64_t overflows = 0;  // items refused by tryPush because the queue was full
  std::size_t highWater = 0;    // most items ever inside
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

  // Waits for room. False: the queue was closed and `item` not taken.
  bool push(T item) {
    std::unique_lock lock(mutex_);
    notFull_.wait(lock, [&] { return closed_ || size_ < capacity_; });
    if (closed_) return false;
    put(std::move(item));
    return true;
  }

  // Never waits. False: full (counted as an overflow) or closed; `item` not taken.
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

  // Waits for an item. Empty: the queue was closed and all its items were handed out.
  std::optional<T> pop() {
    std::unique_lock lock(mutex_);
    notEmpty_.wait(lock, [&] { return closed_ || size_ > 0; });
    return take();
  }

  // Never waits. Empty: nothing inside.
  std::optional<T> tryPop() {
    std::lock_guard lock(mutex_);
    return take();
  }

  // Ends all waiting: pushes fail from now on; pops still hand out what is inside.
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

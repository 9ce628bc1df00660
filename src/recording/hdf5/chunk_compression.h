// Compresses pieces of arrays on several threads, and hands them out in the order in which they
// were given, so that a file doesn't depend on the number of threads. Private to this module.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace palpate {

// Work that one thread gives to others and to itself. Not for several givers.
class OrderedWork {
 public:
  // One piece of work, on some thread; then `finish`, on the giver's thread, in the order of add().
  using Work = std::function<void()>;

  // `threads` besides the giver's; 0: the giver's thread works alone.
  explicit OrderedWork(std::size_t threads);
  // Waits for the running pieces; those that have not begun are dropped.
  ~OrderedWork();
  OrderedWork(const OrderedWork&) = delete;
  OrderedWork& operator=(const OrderedWork&) = delete;

  // Adds a piece. While too many wait, works itself. Throws what work or finish of earlier pieces
  // threw.
  void add(Work work, Work finish);
  // Ends all pieces. Throws as add().
  void finishAll();

 private:
  struct Piece {
    Work work;
    Work finish;
    bool begun = false;
    bool done = false;
    std::exception_ptr failure;
  };

  void runThread();
  // The lock is held at begin and end, not while it works.
  void run(Piece& piece, std::unique_lock<std::mutex>& lock);
  void finishFront();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<Piece>> pieces_;  // in order; the front is finished first
  bool stopped_ = false;
  std::vector<std::jthread> threads_;
};

// The bytes that HDF5's filters `shuffle` and `deflate` make of a chunk: the first bytes of all
// elements, then the second ones, and so on, compressed as a zlib stream.
std::vector<unsigned char> shuffledAndDeflated(const std::vector<unsigned char>& raw,
                                               std::size_t elementBytes,
                                               int level);

}  // namespace palpate

// Work of one thread that several do, and whose results are taken in the order in which it was
// given: so a file doesn't depend on the number of threads that compress its pieces.
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

// How many threads work besides the caller's where `threads` do in all; 0: as many as the machine
// runs at once.
std::size_t otherThreads(std::size_t threads);

// Work that one thread gives to others and to itself. Not for several givers.
class OrderedWork {
 public:
  // One piece of work, on some thread; then `finish`, on the giver's thread, in the order of add().
  using Work = std::function<void()>;

  // `threads` besides the giver's; 0: the giver's thread works alone. At most `mostPieces` wait,
  // run, or are done and not finished.
  OrderedWork(std::size_t threads, std::size_t mostPieces);
  // Waits for the running pieces; those that have not begun are dropped.
  ~OrderedWork();
  OrderedWork(const OrderedWork&) = delete;
  OrderedWork& operator=(const OrderedWork&) = delete;

  // Adds a piece. While there are too many, works itself. Throws what work or finish of earlier
  // pieces threw; the piece that failed stays, and its finish is tried again by the next call.
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
  // The first piece that nobody has begun, or null. The lock is held.
  std::shared_ptr<Piece> firstWaiting() const;
  void finishFront();

  const std::size_t mostPieces_;
  std::mutex mutex_;
  std::condition_variable changed_;
  // In order. Only the giver adds and takes, with the lock; it looks without, the others with it.
  std::deque<std::shared_ptr<Piece>> pieces_;
  bool stopped_ = false;
  std::vector<std::jthread> threads_;
};

}  // namespace palpate

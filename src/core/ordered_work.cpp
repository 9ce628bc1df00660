#include "palpate/core/ordered_work.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace palpate {

std::size_t otherThreads(std::size_t threads) {
  return (threads != 0 ? threads : std::max(1u, std::thread::hardware_concurrency())) - 1;
}

OrderedWork::OrderedWork(std::size_t threads, std::size_t mostPieces) : mostPieces_(mostPieces) {
  try {
    while (threads_.size() < threads) threads_.emplace_back([this] { runThread(); });
  } catch (const std::system_error&) {
    // Fewer threads, or none: the giver works by itself.
  }
}

OrderedWork::~OrderedWork() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
}

void OrderedWork::run(Piece& piece, std::unique_lock<std::mutex>& lock) {
  piece.begun = true;
  lock.unlock();
  std::exception_ptr failure;
  try {
    piece.work();
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  piece.failure = failure;
  piece.done = true;
  changed_.notify_all();
}

std::shared_ptr<OrderedWork::Piece> OrderedWork::firstWaiting() const {
  for (const auto& piece : pieces_)
    if (!piece->begun) return piece;
  return nullptr;
}

void OrderedWork::runThread() {
  std::unique_lock lock(mutex_);
  for (;;) {
    std::shared_ptr<Piece> next;
    changed_.wait(lock, [&] { return stopped_ || (next = firstWaiting()); });
    if (stopped_) return;
    run(*next, lock);
  }
}

void OrderedWork::finishFront() {
  std::unique_lock lock(mutex_);
  const std::shared_ptr<Piece> front = pieces_.front();
  while (!front->done) {
    if (const auto mine = firstWaiting())
      run(*mine, lock);
    else
      changed_.wait(lock, [&] { return front->done; });
  }
  lock.unlock();
  if (front->failure) std::rethrow_exception(front->failure);
  front->finish();
  const std::lock_guard again(mutex_);
  pieces_.pop_front();
}

void OrderedWork::add(Work work, Work finish) {
  auto piece = std::make_shared<Piece>();
  piece->work = std::move(work);
  piece->finish = std::move(finish);
  {
    const std::lock_guard lock(mutex_);
    pieces_.push_back(std::move(piece));
  }
  changed_.notify_one();
  while (pieces_.size() > mostPieces_) finishFront();
}

void OrderedWork::finishAll() {
  while (!pieces_.empty()) finishFront();
}

}  // namespace palpate

#include "recording/hdf5/chunk_compression.h"

#include <stdexcept>
#include <system_error>
#include <utility>

#include <zlib.h>

namespace palpate {
namespace {

constexpr std::size_t kMostPieces = 48;  // that wait, run, or are done and not finished

}  // namespace

OrderedWork::OrderedWork(std::size_t threads) {
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

void OrderedWork::runThread() {
  std::unique_lock lock(mutex_);
  for (;;) {
    std::shared_ptr<Piece> next;
    changed_.wait(lock, [&] {
      if (stopped_) return true;
      for (const auto& piece : pieces_)
        if (!piece->begun) {
          next = piece;
          return true;
        }
      return false;
    });
    if (stopped_) return;
    run(*next, lock);
  }
}

void OrderedWork::finishFront() {
  std::unique_lock lock(mutex_);
  const std::shared_ptr<Piece> front = pieces_.front();
  while (!front->done) {
    // Something that nobody has begun; the front first.
    std::shared_ptr<Piece> mine;
    for (const auto& piece : pieces_)
      if (!piece->begun) {
        mine = piece;
        break;
      }
    if (mine)
      run(*mine, lock);
    else
      changed_.wait(lock, [&] { return front->done; });
  }
  pieces_.pop_front();
  lock.unlock();
  if (front->failure) std::rethrow_exception(front->failure);
  if (front->finish) front->finish();
}

void OrderedWork::add(Work work, Work finish) {
  std::size_t waiting = 0;
  {
    const std::lock_guard lock(mutex_);
    auto piece = std::make_shared<Piece>();
    piece->work = std::move(work);
    piece->finish = std::move(finish);
    pieces_.push_back(std::move(piece));
    waiting = pieces_.size();
  }
  changed_.notify_one();
  while (waiting-- > kMostPieces) finishFront();
}

void OrderedWork::finishAll() {
  for (;;) {
    {
      const std::lock_guard lock(mutex_);
      if (pieces_.empty()) return;
    }
    finishFront();
  }
}

std::vector<unsigned char> shuffledAndDeflated(const std::vector<unsigned char>& raw,
                                               std::size_t elementBytes,
                                               int level) {
  std::vector<unsigned char> shuffled(raw.size());
  const std::size_t count = raw.size() / elementBytes;
  for (std::size_t byte = 0; byte < elementBytes; ++byte)
    for (std::size_t i = 0; i < count; ++i)
      shuffled[byte * count + i] = raw[i * elementBytes + byte];
  uLongf size = compressBound(static_cast<uLong>(raw.size()));
  std::vector<unsigned char> packed(size);
  if (compress2(packed.data(), &size, shuffled.data(), static_cast<uLong>(raw.size()), level) !=
      Z_OK)
    throw std::bad_alloc();
  packed.resize(size);
  return packed;
}

}  // namespace palpate

// Keeps the blocks of a file that were used last. Private to this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <list>
#include <unordered_map>
#include <utility>

namespace palpate {

// Not thread-safe. A reference to a block is valid until the next change of the cache.
template <typename Block>
class BlockCache {
 public:
  // The sizes of the blocks that are kept are at most `mostSize` in all, in any unit; but the last
  // one that was added is always kept.
  explicit BlockCache(std::uint64_t mostSize,
                      std::size_t mostBlocks = std::numeric_limits<std::size_t>::max())
      : mostSize_(mostSize), mostBlocks_(mostBlocks) {}

  // The block of that key, which is now the last used one; null where it is not kept.
  const Block* find(std::int64_t key) {
    const auto found = places_.find(key);
    if (found == places_.end()) return nullptr;
    blocks_.splice(blocks_.begin(), blocks_, found->second);
    return &found->second->block;
  }

  // Drops the blocks that have no room beside one of this size, those first that were not used for
  // longest.
  void makeRoom(std::uint64_t size) {
    while (!blocks_.empty() && (blocks_.size() >= mostBlocks_ || size_ + size > mostSize_)) {
      size_ -= blocks_.back().size;
      places_.erase(blocks_.back().key);
      blocks_.pop_back();
    }
  }

  // Makes room and adds a block; the key must be new.
  const Block& add(std::int64_t key, std::uint64_t size, Block block) {
    makeRoom(size);
    blocks_.push_front({key, size, std::move(block)});
    size_ += size;
    places_[key] = blocks_.begin();
    return blocks_.front().block;
  }

  void clear() {
    blocks_.clear();
    places_.clear();
    size_ = 0;
  }

 private:
  struct Kept {
    std::int64_t key;
    std::uint64_t size;
    Block block;
  };

  std::uint64_t mostSize_;
  std::size_t mostBlocks_;
  std::uint64_t size_ = 0;
  std::list<Kept> blocks_;  // the last used one first
  std::unordered_map<std::int64_t, typename std::list<Kept>::iterator> places_;  // by key
};

}  // namespace palpate

// What waits on its way to another program. It is bounded, so that neither the source nor the
// memory depends on how fast the program reads: beyond a limit the oldest items are dropped and
// counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

namespace palpate {

// `Item` has size() [bytes] and `droppable`. Not thread-safe.
template <typename Item>
class OutletQueue {
 public:
  explicit OutletQueue(std::size_t maxBytes,
                       std::size_t maxItems = std::numeric_limits<std::size_t>::max())
      : maxBytes_(maxBytes), maxItems_(maxItems) {}

  void push(Item item) {
    items_.push_back(std::move(item));
    bytes_ += items_.back().size();
    if (!items_.back().droppable) ++undroppable_;
    for (auto oldest = items_.begin();
         (bytes_ > maxBytes_ || items_.size() > maxItems_) && oldest != items_.end();) {
      if (!oldest->droppable) {
        ++oldest;
        continue;
      }
      bytes_ -= oldest->size();
      oldest = items_.erase(oldest);
      ++dropped_;
    }
  }
  // The oldest item; nullopt: none waits.
  std::optional<Item> pop() {
    if (items_.empty()) return std::nullopt;
    Item item = std::move(items_.front());
    items_.pop_front();
    bytes_ -= item.size();
    if (!item.droppable) --undroppable_;
    return item;
  }

  std::size_t size() const noexcept { return items_.size(); }
  std::size_t bytes() const noexcept { return bytes_; }
  // Whether so much waits that can't be dropped that its owner has to give up.
  bool isOverrun() const noexcept { return undroppable_ > kMaxUndroppable; }
  // Number of items dropped since the last call.
  std::uint64_t takeDropped() noexcept { return std::exchange(dropped_, 0); }

 private:
  static constexpr std::size_t kMaxUndroppable = 64;

  std::size_t maxBytes_;
  std::size_t maxItems_;
  std::deque<Item> items_;
  std::size_t bytes_ = 0;
  std::size_t undroppable_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace palpate

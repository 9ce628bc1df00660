// The samples of a profile, and events beside them, one after the other in order of time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <palpate/model/event.h>
#include <palpate/model/profile.h>

namespace palpate {

class InTimeOrder {
 public:
  // Of equal times the first of these comes first, and the later series before the earlier one: a
  // frame has what was measured up to it.
  enum class Kind : std::uint8_t { kEvent, kSample, kFrame };
  struct Item {
    Kind kind{};
    std::size_t series = 0;   // of a sample
    std::size_t index = 0;    // among those of its kind and series
    std::int64_t timeUs = 0;  // [us since 1970]
    bool operator==(const Item&) const = default;
  };

  // Told of an item whose time can't be read, and why; it is left out.
  using Unreadable = std::function<void(Kind kind, const std::string& fault)>;

  // Events keep their order: one that is earlier than that before it comes right after it. Without
  // `unreadable`, next() and take() throw what reading a time throws.
  InTimeOrder(Profile profile, std::span<const Event> events, Unreadable unreadable = {})
      : profile_(std::move(profile)),
        unreadable_(std::move(unreadable)),
        samplesTaken_(profile_.series().size()) {
    for (const Event& event : events) eventTimesUs_.push_back(event.tUs);
  }

  // The next item; empty after the last one. take() goes on behind it.
  std::optional<Item> next();
  std::optional<Item> take();

 private:
  Profile profile_;
  Unreadable unreadable_;
  std::vector<std::int64_t> eventTimesUs_;
  std::size_t eventsTaken_ = 0;
  std::size_t framesTaken_ = 0;
  std::vector<std::size_t> samplesTaken_;  // by series
};

}  // namespace palpate

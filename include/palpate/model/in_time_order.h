// The samples of a profile, and events beside them, one after the other in order of time.
#pragma once

#include <array>
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
  // Of equal times the first of these comes first: a frame has what was measured up to it.
  enum class Kind : std::size_t { kEvent, kTemperatures, kAngles, kFrame };
  struct Item {
    Kind kind{};
    std::size_t index = 0;    // among those of its kind
    std::int64_t timeUs = 0;  // [us since 1970]
    bool operator==(const Item&) const = default;
  };

  // Told of a sample whose time can't be read, and why; it is left out.
  using Unreadable = std::function<void(Kind kind, const std::string& fault)>;

  // Events keep their order: one that is earlier than that before it comes right after it. Without
  // `unreadable`, next() and take() throw what reading a time throws.
  InTimeOrder(Profile profile, std::span<const Event> events, Unreadable unreadable = {})
      : profile_(std::move(profile)), unreadable_(std::move(unreadable)) {
    for (const Event& event : events) eventTimesUs_.push_back(event.tUs);
  }

  // The next item; empty after the last one. take() goes on behind it.
  std::optional<Item> next();
  std::optional<Item> take();

 private:
  Profile profile_;
  Unreadable unreadable_;
  std::vector<std::int64_t> eventTimesUs_;
  std::array<std::size_t, 4> taken_{};  // by Kind
};

}  // namespace palpate

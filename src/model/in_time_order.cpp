#include "palpate/model/in_time_order.h"

#include "palpate/core/error.h"

namespace palpate {

std::optional<InTimeOrder::Item> InTimeOrder::next() {
  std::optional<Item> first;
  const auto consider = [&](Kind kind, std::size_t count, auto timeOf) {
    for (std::size_t& index = taken_[static_cast<std::size_t>(kind)]; index < count; ++index) {
      try {
        const std::int64_t timeUs = timeOf(index);
        if (!first || timeUs < first->timeUs) first = Item{kind, index, timeUs};
        return;
      } catch (const Error& error) {
        if (!unreadable_) throw;
        unreadable_(kind, error.what());
      }
    }
  };
  const Profile& profile = profile_;
  consider(Kind::kEvent, eventTimesUs_.size(), [&](auto i) { return eventTimesUs_[i]; });
  consider(Kind::kTemperatures, profile.numTemperatures(), [&](auto i) {
    return profile.temperatureTimeUs(i);
  });
  consider(Kind::kAngles, profile.numAngles(), [&](auto i) { return profile.angleTimeUs(i); });
  consider(Kind::kFrame, profile.numFrames(), [&](auto i) { return profile.frameTimeUs(i); });
  return first;
}

std::optional<InTimeOrder::Item> InTimeOrder::take() {
  const std::optional<Item> item = next();
  if (item) ++taken_[static_cast<std::size_t>(item->kind)];
  return item;
}

}  // namespace palpate

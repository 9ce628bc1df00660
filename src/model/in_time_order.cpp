#include "palpate/model/in_time_order.h"

#include "palpate/core/error.h"

namespace palpate {

std::optional<InTimeOrder::Item> InTimeOrder::next() {
  std::optional<Item> first;
  const auto consider =
      [&](Kind kind, std::size_t series, std::size_t& index, std::size_t count, auto timeOf) {
        for (; index < count; ++index) {
          try {
            const std::int64_t timeUs = timeOf(index);
            if (!first || timeUs < first->timeUs) first = Item{kind, series, index, timeUs};
            return;
          } catch (const Error& error) {
            if (!unreadable_) throw;
            unreadable_(kind, error.what());
          }
        }
      };
  consider(Kind::kEvent, 0, eventsTaken_, eventTimesUs_.size(), [&](std::size_t i) {
    return eventTimesUs_[i];
  });
  for (std::size_t series = samplesTaken_.size(); series-- > 0;)
    consider(Kind::kSample,
             series,
             samplesTaken_[series],
             profile_.numSamples(series),
             [&](std::size_t i) { return profile_.sampleTimeUs(series, i); });
  consider(Kind::kFrame, 0, framesTaken_, profile_.numFrames(), [&](std::size_t i) {
    return profile_.frameTimeUs(i);
  });
  return first;
}

std::optional<InTimeOrder::Item> InTimeOrder::take() {
  const std::optional<Item> item = next();
  if (!item) return item;
  if (item->kind == Kind::kEvent) ++eventsTaken_;
  if (item->kind == Kind::kSample) ++samplesTaken_[item->series];
  if (item->kind == Kind::kFrame) ++framesTaken_;
  return item;
}

}  // namespace palpate

#include "palpate/model/in_time_order.h"

namespace palpate {

std::optional<InTimeOrder::Item> InTimeOrder::next() const {
  std::optional<Item> first;
  const auto consider = [&](const Item& item) {
    if (!first || item.timeUs < first->timeUs) first = item;
  };
  if (eventsTaken_ < eventTimesUs_.size())
    consider({Kind::kEvent, 0, eventsTaken_, eventTimesUs_[eventsTaken_]});
  for (std::size_t series = samplesTaken_.size(); series-- > 0;)
    if (const std::size_t next = samplesTaken_[series]; next < profile_.numSamples(series))
      consider({Kind::kSample, series, next, profile_.sampleTimeUs(series, next)});
  if (framesTaken_ < profile_.numFrames())
    consider({Kind::kFrame, 0, framesTaken_, profile_.frameTimeUs(framesTaken_)});
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

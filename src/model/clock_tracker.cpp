#include "model/clock_tracker.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace palpate {
namespace {

constexpr std::int64_t kMaxAheadUs = 10'000'000;
// Largest difference of the two clocks at a wrap.
constexpr std::int64_t kWrapToleranceUs = 2'000'000;
constexpr std::int64_t kWrapsUs[] = {std::int64_t{1} << 32, 1000 * (std::int64_t{1} << 32)};
// Times are kept in a range in which their differences don't overflow.
constexpr std::int64_t kLargestUs = INT64_MAX / 8;

}  // namespace

// Empty: one can't follow the other.
std::optional<std::int64_t> ClockTracker::stepOf(const Item& from, const Item& to) {
  const std::int64_t passedUs = to.hostUs - from.hostUs;
  std::int64_t stepUs = to.sentUs - from.sentUs;
  for (const std::int64_t wrapUs : kWrapsUs)
    if (stepUs < 0 && from.sentUs < wrapUs && to.sentUs >= 0 &&
        std::abs(stepUs + wrapUs - passedUs) <= kWrapToleranceUs)
      stepUs += wrapUs;
  if (stepUs < 0 || stepUs > passedUs + kMaxAheadUs) return std::nullopt;
  return stepUs;
}

void ClockTracker::accept(const Item& item, Verdict verdict, std::vector<Judged>& judged) {
  beforeLast_ = verdict == Verdict::kRestart ? std::nullopt : last_;
  last_ = item;
  judged.push_back({item.item, verdict, item.hostUs, item.deviceUs});
}

void ClockTracker::push(const ClockStamp& stamp, std::vector<Judged>& judged) {
  Item item{.item = items_++, .hostUs = std::clamp(stamp.hostUs, -kLargestUs, kLargestUs)};
  if (!stamp.deviceUs) {
    judged.push_back({item.item, Verdict::kUnusable, item.hostUs, 0});
    return;
  }
  item.sentUs = item.deviceUs = std::clamp(*stamp.deviceUs, -kLargestUs, kLargestUs);
  const auto follow = [&](Item from, Item& to) {
    const auto step = stepOf(from, to);
    if (step) to.deviceUs = std::min(from.deviceUs + *step, kLargestUs);
    return step.has_value();
  };
  if (!last_) return accept(item, Verdict::kGood, judged);
  if (follow(*last_, item)) {
    finish(judged);
    return accept(item, Verdict::kGood, judged);
  }
  if (beforeLast_ && !waiting_ && follow(*beforeLast_, item)) {
    judged.push_back({last_->item, Verdict::kUnusable, last_->hostUs, 0});
    last_ = beforeLast_;
    return accept(item, Verdict::kGood, judged);
  }
  if (waiting_ && follow(*waiting_, item)) {
    accept(*std::exchange(waiting_, std::nullopt), Verdict::kRestart, judged);
    return accept(item, Verdict::kGood, judged);
  }
  finish(judged);
  item.deviceUs = item.sentUs;
  waiting_ = item;
}

void ClockTracker::finish(std::vector<Judged>& judged) {
  if (waiting_) judged.push_back({waiting_->item, Verdict::kUnusable, waiting_->hostUs, 0});
  waiting_.reset();
}

}  // namespace palpate

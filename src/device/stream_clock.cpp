#include "device/stream_clock.h"

#include <algorithm>
#include <cstdlib>

namespace palpate {
namespace {

constexpr std::int64_t kMaxAheadUs = 10'000'000;
// Largest difference of the two clocks at a wrap.
constexpr std::int64_t kWrapToleranceUs = 2'000'000;
constexpr std::int64_t kWrapsUs[] = {std::int64_t{1} << 32, 1000 * (std::int64_t{1} << 32)};
constexpr std::int64_t kSpeedAfterUs = 2'000'000;
// Times are kept in a range in which their differences don't overflow.
constexpr std::int64_t kLargestUs = INT64_MAX / 4;

}  // namespace

std::int64_t StreamClock::next(std::int64_t deviceUs, std::int64_t monotonicUs) {
  deviceUs = std::clamp(deviceUs, -kLargestUs, kLargestUs);
  restarted_ = false;
  if (!first_) {
    first_ = last_ = {deviceUs, monotonicUs};
    return unwrappedUs_ = deviceUs;
  }
  const std::int64_t passedUs = std::max<std::int64_t>(monotonicUs - last_.monotonicUs, 0);
  std::int64_t stepUs = deviceUs - last_.deviceUs;
  if (stepUs < 0) {
    for (const std::int64_t wrapUs : kWrapsUs) {
      if (last_.deviceUs >= wrapUs || deviceUs < 0) continue;
      const std::int64_t wrappedUs = stepUs + wrapUs;
      if (std::abs(wrappedUs - passedUs) <= kWrapToleranceUs) stepUs = wrappedUs;
      if (stepUs >= 0) break;
    }
  }
  restarted_ = stepUs < 0 || stepUs > passedUs + kMaxAheadUs;
  last_ = {deviceUs, monotonicUs};
  if (restarted_) {
    stepUs = passedUs;
    first_ = last_;
    sinceFirstUs_ = 0;
  } else {
    sinceFirstUs_ += stepUs;
  }
  return unwrappedUs_ += stepUs;
}

std::optional<double> StreamClock::speed() const {
  if (!first_) return std::nullopt;
  const std::int64_t passedUs = last_.monotonicUs - first_->monotonicUs;
  if (passedUs < kSpeedAfterUs) return std::nullopt;
  return static_cast<double>(sinceFirstUs_) / static_cast<double>(passedUs);
}

}  // namespace palpate

#include "device/frame_numbers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpate {
namespace {

// Frames that arrive this many numbers late were overtaken; further back the sender restarted.
constexpr std::int32_t kMaxLate = 64;
// More frames with the same number are those of a sender that does not count any more.
constexpr int kMaxRepeated = 2;
// Frames that may be missing beyond what the time could have held.
constexpr double kSpareFrames = 64.0;
constexpr double kTimeMargin = 2.0;
constexpr std::int32_t kMaxMissingWithoutTime = 1000;
constexpr double kRateUs = 10e6;
// Frames that waited in a buffer arrive together after a pause. The numbers lost behind them belong
// to the time of the pause, so this time is remembered for a while.
constexpr double kOutstandingUs = 5e6;
// After so many frames and this time without their longest interval the rate is known.
constexpr int kFirstFrames = 32;
constexpr double kFirstUs = 1000.0;

}  // namespace

FrameNumbers::Step FrameNumbers::next(std::uint32_t number,
                                      std::optional<std::int64_t> timeUs,
                                      bool mayBeLate) {
  if (!last_) {
    last_ = number;
    timeUs_ = timeUs;
    return {};
  }
  const auto step = static_cast<std::int32_t>(number - *last_);
  // A sender that does not count, or no longer.
  if (step == 0) {
    const bool repeated = counts_ && numRepeated_ < kMaxRepeated;
    if (repeated) ++numRepeated_;
    return {.repeated = repeated};
  }
  numRepeated_ = 0;
  if (isMissing(step)) {
    came_ |= std::uint64_t{1} << -step;
    return {.late = true};
  }
  if (mayBeLate && step < 0 && step >= -kMaxLate && late_ != number - 1) {
    late_ = number;
    return {.late = true};
  }
  late_.reset();
  last_ = number;
  std::optional<double> passedUs;
  if (timeUs && timeUs_)
    passedUs = std::max(static_cast<double>(*timeUs) - static_cast<double>(*timeUs_), 0.0);
  timeUs_ = timeUs;
  if (step < 0 || !couldBeMissing(step - 1, passedUs)) {
    outstanding_ = std::min(outstanding_, 0.0);
    came_ = 1;
    numKnown_ = 1;
    counts_ = false;
    return {.renumbered = true};
  }
  noteStep(step);
  return {.missing = static_cast<std::uint64_t>(step - 1)};
}

bool FrameNumbers::isMissing(std::int32_t step) const {
  return step < 0 && step > -numKnown_ && (came_ >> -step & 1) == 0;
}

void FrameNumbers::noteStep(std::int32_t step) {
  counts_ = true;
  came_ = (step < kMaxLate ? came_ << step : 0) | 1;
  numKnown_ = std::min(kMaxLate, numKnown_ + std::min(step, kMaxLate));
}

bool FrameNumbers::couldBeMissing(std::int32_t missing, std::optional<double> passedUs) {
  if (!passedUs) return missing < kMaxMissingWithoutTime;
  const double us = *passedUs;
  const double held = recentUs_ > 0.0 ? us * recentNumbers_ / recentUs_ : 0.0;
  const double balance = outstanding_ * std::exp(-us / kOutstandingUs) + held;
  const double limit = kSpareFrames + (balance > 0.0 ? kTimeMargin : 1.0) * balance;
  if (missing > limit) return false;
  outstanding_ = std::max(balance - missing - 1.0, -kSpareFrames);
  const double kept = std::exp(-us / kRateUs);
  recentUs_ = recentUs_ * kept + us;
  recentNumbers_ = recentNumbers_ * kept + missing + 1.0;
  if (numFirst_ < kFirstFrames) {
    ++numFirst_;
    pauseUs_ = std::max(pauseUs_, us);
  } else if (pauseUs_ > 0.0 && recentUs_ > pauseUs_ + kFirstUs) {
    recentUs_ -= pauseUs_;
    outstanding_ += std::exchange(pauseUs_, 0.0) * recentNumbers_ / recentUs_;
  }
  return true;
}

}  // namespace palpate

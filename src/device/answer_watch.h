// How long the answers of a motion controller may be missing or not valid before its hand, which
// may be moving, is stopped.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "palpate/core/time.h"

namespace palpate {

class AnswerWatch {
 public:
  using Milliseconds = std::chrono::milliseconds;

  // 0: no limit.
  void setLimit(Milliseconds limit) noexcept {
    limit_ = limit;
    numBad_ = 0;
  }
  bool isLimited() const noexcept { return limit_.count() > 0; }
  void onGood() noexcept { numBad_ = 0; }
  // The request that was sent at `requestUs` [monotonic us] got no answer, or one that is not
  // valid.
  void onBad(std::int64_t requestUs) noexcept {
    if (numBad_++ == 0) sinceUs_ = requestUs;
  }
  // True when no good answer can arrive in time any more. One bad answer is never too many, however
  // long this process stood still meanwhile.
  bool isOver(std::int64_t nowUs) const noexcept {
    return isLimited() && numBad_ > 1 &&
           nowUs + usOf(2 * silence() + kAnswer) >= sinceUs_ + usOf(limit_);
  }
  // With a limit: how long to wait for one answer, and for the silence that ends a damaged one
  // (twice before the next request).
  Milliseconds timeout(std::int64_t nowUs) const noexcept {
    const Milliseconds usual = limit_ / 5;
    if (numBad_ < 2) return usual;
    const std::int64_t leftUs = sinceUs_ + usOf(limit_ - kLook) - nowUs;
    return std::clamp(Milliseconds(leftUs / kUsPerMs), Milliseconds(1), usual);
  }
  Milliseconds silence() const noexcept { return limit_ / 20; }

 private:
  // An answer is waited for in whole milliseconds, and looked for once more at the end.
  static constexpr Milliseconds kLook{3};
  // Twice the usual time of an answer.
  static constexpr Milliseconds kAnswer{8};

  Milliseconds limit_{0};
  int numBad_ = 0;            // in succession
  std::int64_t sinceUs_ = 0;  // when the first of them was requested
};

}  // namespace palpate

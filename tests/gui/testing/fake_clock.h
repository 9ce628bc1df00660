// A clock that stands still until a test moves it on.
#pragma once

#include <cstdint>

#include <palpate/core/time.h>

namespace palpate::gui {

class FakeClock : public Clock {
 public:
  std::int64_t monotonicUs() const override { return nowUs_; }
  std::int64_t wallUs() const override { return nowUs_; }
  void advanceMs(std::int64_t ms) { nowUs_ += ms * 1000; }

 private:
  std::int64_t nowUs_ = 5'000'000;
};

}  // namespace palpate::gui

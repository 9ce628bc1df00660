// Host time: wall clock at the start plus the monotonic clock since, so that it never jumps.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace palpate {

inline constexpr std::int64_t kUsPerMs = 1000;
inline constexpr double kUsPerS = 1e6;
inline constexpr double kMsPerS = 1e3;
constexpr std::int64_t usOf(std::chrono::milliseconds time) { return kUsPerMs * time.count(); }
// Whole milliseconds of a time [us], rounded down before 1970, too.
constexpr std::int64_t floorMs(std::int64_t us) {
  return us / kUsPerMs - (us % kUsPerMs < 0 ? 1 : 0);
}

// Where time comes from; tests hand in one they move by hand.
class Clock {
 public:
  virtual ~Clock() = default;
  // Monotonic time [us] since an arbitrary start; never goes back. The machine's own goes on while
  // the machine sleeps (CLOCK_BOOTTIME), so that stamps don't lag after it.
  virtual std::int64_t monotonicUs() const = 0;
  // Wall clock [us since 1970, UTC]; may jump.
  virtual std::int64_t wallUs() const = 0;
};

// The machine's own clock (one, shared: it has no state).
const Clock& systemClock();

// Host time stamps of one recording [us since 1970].
class HostTime {
 public:
  explicit HostTime(const Clock& clock = systemClock());
  // Wall clock at construction plus monotonic time since. Never goes back.
  std::int64_t nowUs() const;
  // How far the wall clock has moved away from nowUs() [us]: a jump of the wall clock.
  std::int64_t wallOffsetUs() const;

 private:
  const Clock& clock_;
  std::int64_t wallStartUs_;
  std::int64_t monotonicStartUs_;
};

// "2014-11-27 10:31:05.123" in UTC for a host time [us since 1970].
std::string utcText(std::int64_t hostUs);

}  // namespace palpate

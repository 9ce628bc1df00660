// Host time, the time stamp of all recorded data: the wall clock at the start plus the monotonic
// clock since then, so that it never jumps.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace palpate {

inline constexpr std::int64_t kUsPerMs = 1000;
inline constexpr double kUsPerS = 1e6;
inline constexpr double kMsPerS = 1e3;
constexpr std::int64_t usOf(std::chrono::milliseconds time) { return kUsPerMs * time.count(); }
// Whole milliseconds of a time [us], rounded down also before 1970.
constexpr std::int64_t floorMs(std::int64_t us) {
  return us / kUsPerMs - (us % kUsPerMs < 0 ? 1 : 0);
}
// The microseconds of a time [ms] that was read from a file; nothing where they are out of range.
constexpr std::optional<std::int64_t> checkedUs(std::int64_t ms) {
  constexpr std::int64_t kMaxMs = INT64_MAX / kUsPerMs;
  return ms < -kMaxMs || ms > kMaxMs ? std::nullopt : std::optional(ms * kUsPerMs);
}

// A source of time; tests use one that they set themselves.
class Clock {
 public:
  virtual ~Clock() = default;
  // Monotonic time [us] since an arbitrary start; it never decreases. The machine's clock continues
  // while the machine sleeps (CLOCK_BOOTTIME), so that stamps do not lag behind.
  virtual std::int64_t monotonicUs() const = 0;
  // Wall clock [us since 1970, UTC]; may jump.
  virtual std::int64_t wallUs() const = 0;
};

// The machine's own clock; one shared object without state.
const Clock& systemClock();

// Host time stamps of one recording [us since 1970].
class HostTime {
 public:
  explicit HostTime(const Clock& clock = systemClock());
  // Returns the wall clock at construction plus the monotonic time since then. Never decreases.
  std::int64_t nowUs() const;
  // Difference of the wall clock and nowUs() [us], caused by a jump of the wall clock.
  std::int64_t wallOffsetUs() const;

 private:
  const Clock& clock_;
  std::int64_t wallStartUs_;
  std::int64_t monotonicStartUs_;
};

// Returns a host time [us since 1970] as "2014-11-27 10:31:05.123" in UTC.
std::string utcText(std::int64_t hostUs);
// The same in the local time of the machine, by a format of strftime().
std::string localText(std::int64_t hostUs, const char* format);

// Returns the wall clock in whole seconds, as models and calibrations store the time at which they
// were made: "2014-11-28T10:36:11Z".
inline std::string utcStamp(const Clock& clock = systemClock()) {
  const std::string text = utcText(clock.wallUs());
  return text.substr(0, 10) + "T" + text.substr(11, 8) + "Z";
}

}  // namespace palpate

// The clock of a sender whose times arrive with its frames: unwraps counters of 32 bits, and
// continues after a restart of the sender.
#pragma once

#include <cstdint>
#include <optional>

namespace palpate {

class StreamClock {
 public:
  // Returns the unwrapped time of a frame [us]. It never decreases. deviceUs: as received, of a
  // counter that may wrap at 2^32 us or 2^32 ms; monotonicUs: time of arrival.
  //
  // A time that goes back without such a wrap, or runs ahead of the time of arrival by more than 10
  // s, is a restart: from there on the time continues after the last frame by the time that passed.
  std::int64_t next(std::int64_t deviceUs, std::int64_t monotonicUs);
  // True when the last call to next() found a restart.
  bool restarted() const noexcept { return restarted_; }
  // How fast the device's clock runs, compared with ours, since the last restart; empty during the
  // first two seconds.
  std::optional<double> speed() const;

 private:
  struct Stamp {
    std::int64_t deviceUs = 0;
    std::int64_t monotonicUs = 0;
  };
  std::optional<Stamp> first_;  // since the last restart
  Stamp last_;
  std::int64_t unwrappedUs_ = 0;
  std::int64_t sinceFirstUs_ = 0;  // device time since first_
  bool restarted_ = false;
};

}  // namespace palpate

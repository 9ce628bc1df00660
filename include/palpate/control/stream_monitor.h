// Watchdog of the tactile stream: a grasp under tactile control requires a live stream.
//
// The stream is dead after 100 ms without a frame, or after three median periods if that is longer
// (a raw stream delivers a frame every 85 ms).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace palpate {

class StreamMonitor {
 public:
  static constexpr std::int64_t kMinSilenceUs = 100'000;
  static constexpr int kPeriods = 3;

  // Call this for every frame with its host stamp and its arrival in monotonic time [us]. Returns
  // the silence before it [us] if the stream counted as dead.
  std::optional<std::int64_t> frame(std::int64_t stampUs, std::int64_t monoUs);
  void reset() { *this = {}; }

  // True once enough frames have arrived to know the period.
  bool known() const noexcept { return count_ >= kMinIntervals; }
  std::int64_t medianPeriodUs() const;  // of the last 15 periods; 0: not known
  std::int64_t silenceLimitUs() const;  // [us]
  // Time since the newest frame [us]; empty before the first one.
  std::optional<std::int64_t> silenceUs(std::int64_t monoUs) const;
  // True when known() and not silent for longer than the limit.
  bool alive(std::int64_t monoUs) const;
  // Time from which the stream counts as dead unless a frame arrives [monotonic us].
  std::int64_t deadAtUs() const { return lastMonoUs_ + silenceLimitUs(); }

 private:
  static constexpr std::size_t kKept = 15;
  static constexpr std::size_t kMinIntervals = 3;
  std::array<std::int64_t, kKept> periods_{};
  std::size_t count_ = 0;  // number of periods since reset()
  std::optional<std::int64_t> lastStampUs_;
  std::int64_t lastMonoUs_ = 0;
};

}  // namespace palpate

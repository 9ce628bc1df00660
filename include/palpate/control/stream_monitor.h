// Watchdog of the tactile stream: a grasp under tactile control requires a live stream.
//
// Dead means: no frame for 100 ms, or for three median periods where that is longer (a raw stream
// brings a frame every 85 ms).
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

  // A frame with this host stamp was seen at this monotonic time [us]. Returns the silence before
  // it, when that was long enough to count as dead [us].
  std::optional<std::int64_t> frame(std::int64_t stampUs, std::int64_t monoUs);
  void reset() { *this = {}; }

  // Enough frames have come to know the period.
  bool known() const noexcept { return count_ >= kMinIntervals; }
  std::int64_t medianPeriodUs() const;  // of the last 15; 0: not known
  std::int64_t silenceLimitUs() const;  // [us]
  // How long nothing has come [us]; nothing: no frame ever came.
  std::optional<std::int64_t> silenceUs(std::int64_t monoUs) const;
  // known(), and not silent for longer than the limit.
  bool alive(std::int64_t monoUs) const;
  // When the stream will count as dead if nothing comes [monotonic us].
  std::int64_t deadAtUs() const { return lastMonoUs_ + silenceLimitUs(); }

 private:
  static constexpr std::size_t kKept = 15;
  static constexpr std::size_t kMinIntervals = 3;
  std::array<std::int64_t, kKept> periods_{};
  std::size_t count_ = 0;  // periods ever seen
  std::optional<std::int64_t> lastStampUs_;
  std::int64_t lastMonoUs_ = 0;
};

}  // namespace palpate

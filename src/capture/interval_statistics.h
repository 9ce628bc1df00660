// Interval statistics of a running recording: the same figures as model/timing.h computes for a
// finished one, in memory that doesn't grow with the number of frames. Used by RecordingParts.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace palpate {

class IntervalStatistics {
 public:
  void add(std::int64_t stampUs);  // stamps must increase strictly

  std::int64_t frames() const noexcept { return frames_; }
  std::int64_t firstUs() const noexcept { return firstUs_; }
  std::int64_t lastUs() const noexcept { return lastUs_; }
  double durationS() const noexcept;   // first to last
  double meanRateHz() const noexcept;  // (frames - 1) / duration
  double rateHz() const noexcept;      // as in TimingReport
  std::int64_t gaps() const noexcept;  // intervals longer than max(1 s, 5 median intervals)
  double gapsS() const noexcept;       // their sum

 private:
  double medianUs() const noexcept;
  std::int64_t intervalAt(std::int64_t rank) const noexcept;

  // Intervals under a second are counted individually, in pages allocated when needed.
  static constexpr std::int64_t kPage = 1000;
  static constexpr std::int64_t kPages = 1000;
  static constexpr std::size_t kMaxLongIntervals = 1'000'000;
  using Page = std::array<std::uint32_t, kPage>;
  std::array<std::unique_ptr<Page>, kPages> pages_;
  std::vector<std::int64_t> longOnes_;  // one second and longer, the first million [us]
  std::int64_t frames_ = 0;
  std::int64_t firstUs_ = 0;
  std::int64_t lastUs_ = 0;
};

}  // namespace palpate

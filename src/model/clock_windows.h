// The fastest arrivals of a sender's items, window by window, and what they say of its clock: the
// line through them, and where the clock jumped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace palpate {

// A second or more of a stretch. Lags are hostUs - deviceUs over that of the stretch's first item.
struct ClockWindow {
  std::int64_t beginUs = 0;  // arrival of its first item
  std::int64_t endUs = 0;    // of its last one
  std::size_t items = 0;
  double deviceS = 0.0;        // sender's time of the fastest arrival, from the first item on [s]
  double fastestUs = 0.0;      // its lag
  double slowestUs = 0.0;      // largest lag
  double longestStepUs = 0.0;  // longest time between two items, and mean, by the sender's clock
  double meanStepUs = 0.0;
};

class ClockWindows {
 public:
  // Both times ascend [us].
  void add(std::int64_t hostUs, std::int64_t deviceUs);
  std::deque<ClockWindow>& all() noexcept { return all_; }
  const std::deque<ClockWindow>& all() const noexcept { return all_; }
  double lagUs(std::int64_t hostUs, std::int64_t deviceUs) const noexcept {
    return static_cast<double>(hostUs - deviceUs - lagUs_);
  }
  double deviceS(std::int64_t deviceUs) const noexcept {
    return static_cast<double>(deviceUs - deviceUs_) / 1e6;
  }
  // Of the first item [us].
  std::int64_t firstLagUs() const noexcept { return lagUs_; }

 private:
  std::deque<ClockWindow> all_;
  std::int64_t lagUs_ = 0;
  std::int64_t deviceUs_ = 0;
  std::int64_t lastDeviceUs_ = 0;
};

// The lag of the fastest arrivals as lines between knots, at most ten minutes apart.
struct ClockLine {
  std::vector<double> atS;  // sender's time [s], ascending; at least one
  std::vector<double> lagUs;
  bool measured = false;  // the slope: from enough windows
  double delaySpreadUs = 0.0;
  double rmsUs = 0.0;
  double boundUs = 0.0;

  double at(double deviceS) const;
  // Of the lag [us/s], which is -drift in ppm.
  double slope() const;
};
// `slope` is used where there are too few windows to measure one [us/s]. Windows must not be empty.
ClockLine clockLineOf(const std::deque<ClockWindow>& windows, double slope = 0.0);

// A change of the lag that stays, as after a restart or a jump of the clock.
struct ClockStep {
  std::size_t window = 0;  // about where the new lag begins
  double slope = 0.0;      // of the lag on both sides [us/s]
  double beforeUs = 0.0;   // the lag less slope x deviceS
  double afterUs = 0.0;
  double usualStepUs = 0.0;  // between two items by the sender's clock
};
std::optional<ClockStep> clockStepIn(const std::deque<ClockWindow>& windows);

}  // namespace palpate

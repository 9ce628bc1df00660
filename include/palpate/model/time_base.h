// Fits the clock of a sender to the times of arrival. Items that wait and arrive together keep the
// distances that the sender measured; what a delay adds is taken off, up to a constant: the fastest
// arrivals are the reference.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/option_check.h>

namespace palpate {

// Which times a result is computed with.
enum class TimeChoice : std::uint8_t {
  kArrival,  // hostUs as recorded
  kFitted    // the sender's clock, fitted to it
};
inline constexpr std::array<OptionWord<TimeChoice>, 2> kTimeChoiceWords{
    {{"arrival", TimeChoice::kArrival}, {"fitted", TimeChoice::kFitted}}};

// The two times of a frame or a sample.
struct ClockStamp {
  std::int64_t hostUs = 0;               // time of arrival [us]; strictly ascending
  std::optional<std::int64_t> deviceUs;  // the sender's clock [us]
};

// What is known of a sender's clock.
struct ClockReport {
  std::size_t items = 0;
  // Items without a time of the sender, or with a wrong one; their times of arrival are used.
  std::size_t unusable = 0;
  std::size_t restarts = 0;  // the clock restarted, or jumped
  // How much faster than ours it runs [1e-6]; empty below ten windows of a second.
  std::optional<double> driftPpm = {};
  // By how much delays vary within a window, as a rule [ms].
  double delaySpreadMs = 0.0;
  // Deviation of the fastest arrivals from the fit [ms]: standard deviation and largest.
  double rmsMs = 0.0;
  double boundMs = 0.0;
};
// "drift 100.2 ppm, delays vary by 41.0 ms, 1 restart, error 0.2 ms (at most 0.9)".
std::string clockText(const ClockReport& report);

// The fit while items arrive, in bounded memory: of the last five minutes since a restart.
class ClockMonitor {
 public:
  ClockMonitor();
  ~ClockMonitor();
  ClockMonitor(ClockMonitor&&) noexcept;
  ClockMonitor& operator=(ClockMonitor&&) noexcept;
  void add(const ClockStamp& stamp);
  // Empty as long as no item had a time of the sender.
  std::optional<ClockReport> report() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The fit of a whole recording.
class TimeBase {
 public:
  // A stretch between two restarts.
  struct Stretch {
    std::size_t begin = 0;  // items, without the end
    std::size_t end = 0;
    std::optional<double> driftPpm;  // as ClockReport
    double delaySpreadMs = 0.0;
    double rmsMs = 0.0;
    double boundMs = 0.0;
  };

  // Empty where there is nothing to fit (no times of the sender, fewer than 20 that are usable, a
  // clock that runs more than 1 % too fast or too slow); `why` then says so.
  static std::optional<TimeBase> fit(std::span<const ClockStamp> stamps,
                                     std::string* why = nullptr);

  // One per item [us], strictly ascending.
  const std::vector<std::int64_t>& timesUs() const noexcept { return timesUs_; }
  const std::vector<Stretch>& stretches() const noexcept { return stretches_; }
  const ClockReport& report() const noexcept { return report_; }

 private:
  std::vector<std::int64_t> timesUs_;
  std::vector<Stretch> stretches_;
  ClockReport report_;
};

}  // namespace palpate

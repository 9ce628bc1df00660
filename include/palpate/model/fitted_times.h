// A recording seen over the clocks of its senders instead of the times of arrival (time_base.h).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/model/time_base.h>

namespace palpate {

// The clock of the frames or of a series.
struct FittedClock {
  std::string name;  // "frames", or that of the series
  // Empty where the times of arrival stay; `why` says why: "no times of the sender's clock".
  std::optional<TimeBase> base;
  std::string why;
  bool isWithoutTimes = false;  // no item has a time of a sender
  // "frames: drift 100 ppm, ..", "frames: no times of the sender's clock; the times of arrival
  // are used".
  std::string text() const;
};
// That of the frames, then those of the series with a time of their sender. A frame that can't be
// read has no time of its sender. Throws Error (a series that can't be read), Cancelled.
std::vector<FittedClock> clocksOf(const Profile& profile, const Progress& progress = {});
// The same where the frames have been read: their times of the sender [us]; empty: none has one.
std::vector<FittedClock> clocksOf(const Profile& profile,
                                  std::span<const std::optional<std::int64_t>> framesDeviceUs);

struct FittedTimes {
  Profile profile;  // the same frames and samples at fitted times
  std::vector<FittedClock> clocks;
};
// The frames and each series by their own clocks; where there is nothing to fit, the times of
// arrival stay. Events have times of this machine and stay as they are. Throws as clocksOf().
FittedTimes fittedTimes(const Profile& profile, const Progress& progress = {});

}  // namespace palpate

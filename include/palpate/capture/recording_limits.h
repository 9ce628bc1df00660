// When a recording stops by itself, and when it goes on in a new file: in the units in which
// operators give them, with the ranges that the command line and the window accept.
#pragma once

#include <optional>
#include <string>

#include <palpate/capture/recorder.h>
#include <palpate/core/option_check.h>

namespace palpate {

struct RecordingLimits {
  static constexpr OptionRange kStopAfterS{0.05, 1e7, "s"};
  static constexpr OptionRange kSplitMinutes{1.0 / 60.0, 1e5, "min"};
  static constexpr OptionRange kSplitMb{0.1, 1e6, "MB"};

  // Duration from the first frame after the start [s].
  std::optional<double> stopAfterS = {};
  // Duration of a part [min].
  std::optional<double> splitMinutes = {};
  // Approximate size of a part [10^6 bytes].
  std::optional<double> splitMb = {};

  // Throws std::invalid_argument that names the field and its range.
  void validate() const;
  // Sets stopAfterS, splitS and splitBytes of `options`. Throws as validate().
  void applyTo(RecordingOptions& options) const;
  bool operator==(const RecordingLimits&) const = default;
};

// The limits in words: "stops after 30 s, a new file every 10 min or 500 MB"; empty: there is none.
std::string textOf(const RecordingLimits& limits);

}  // namespace palpate

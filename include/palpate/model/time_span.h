// A span of time in a recording; charts, sessions and selections use it.
#pragma once

namespace palpate {

// Seconds from the first frame; when two recordings are compared, from the first frame of the first
// recording. fromS <= toS.
struct TimeSpan {
  double fromS = 0.0;
  double toS = 0.0;
  double lengthS() const noexcept { return toS - fromS; }
  bool operator==(const TimeSpan&) const = default;
};

}  // namespace palpate

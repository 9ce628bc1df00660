// A part of a recording, as charts, sessions and selections name it.
#pragma once

namespace palpate {

// In seconds from the first frame (of two recordings, that of the first); fromS <= toS.
struct TimeSpan {
  double fromS = 0.0;
  double toS = 0.0;
  double lengthS() const noexcept { return toS - fromS; }
  bool operator==(const TimeSpan&) const = default;
};

}  // namespace palpate

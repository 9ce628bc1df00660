// A part of a recording, as charts, sessions and selections name it.
#pragma once

namespace palpate::gui {

// In seconds from the first frame; fromS <= toS.
struct TimeSpan {
  double fromS = 0.0;
  double toS = 0.0;
  bool operator==(const TimeSpan&) const = default;
};

}  // namespace palpate::gui

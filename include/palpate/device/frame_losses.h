// What a source of frames lost, refused or sent beyond the range of its hand, and the one text that
// commands and the window have for it.
#pragma once

#include <cstdint>
#include <string>

namespace palpate {

struct FrameLosses {
  std::int64_t lost = 0;        // frames that were sent and not received
  std::int64_t refused = 0;     // lines, packets or frames that were left out (PortStatus::suspect)
  std::int64_t outOfRange = 0;  // frames that were kept, with values outside the hand's range
  // Why the last one was refused, and which value was out of range; may be empty.
  std::string lastRefused = {};
  std::string lastOutOfRange = {};
};

// One line: "31 frames lost on the way, 2 refused (the last: line 812: ..), 3 frames with values
// outside the hand's range"; empty: nothing.
std::string textOf(const FrameLosses& losses);

}  // namespace palpate

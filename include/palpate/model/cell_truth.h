// What is true of a taxel in a frame, where that is known: of the emulated hand, and of an empty
// hand's recording.
#pragma once

#include <cstdint>
#include <vector>

namespace palpate {

enum class CellTruth : std::uint8_t {
  // nothing presses on it (less than half a count of it): when it is active, it is a ghost
  kNothing,
  kFaint,   // pressed, but too little to be reported without noise: neither true nor false
  kTouched  // pressed, and reported without noise: more than the same sensor says at rest
};
using CellTruthMask = std::vector<CellTruth>;  // one per place of the layout

}  // namespace palpate

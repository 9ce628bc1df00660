// True state of each taxel in a frame, where it is known: in simulated recordings and in the
// recording of an empty hand. It is compared with the detected state to rate the removal of ghosts.
#pragma once

#include <cstdint>
#include <vector>

namespace palpate {

// Whether something presses on a taxel.
enum class CellTruth : std::uint8_t {
  // Nothing presses on the taxel (less than half a count): when it is active, it is a ghost.
  kNothing,
  // Something presses on the taxel, but too weakly to be reported without noise: neither touched
  // nor untouched.
  kFaint,
  // The taxel is pressed: without noise its reading would exceed the reading at rest.
  kTouched
};
using CellTruthMask = std::vector<CellTruth>;  // one per place of the layout

}  // namespace palpate

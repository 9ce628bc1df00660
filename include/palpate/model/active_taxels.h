// What a file says of each taxel of a frame beside its value: the same in all forms.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <palpate/model/tactile_frame.h>

namespace palpate {

// Whether a taxel is active (touched): TactileFrame::values.
inline bool isActive(const TactileFrame& frame, std::size_t place) {
  return isTouched(frame.values[place]);
}
// Whether `values` holds what is in allValues(), also where that is below 0. Elsewhere, in a
// filtered frame, it is +0. Files store it, so that `values` comes back.
inline bool isKept(const TactileFrame& frame, std::size_t place) {
  return frame.filtered.empty() || std::bit_cast<std::uint32_t>(frame.values[place]) != 0;
}

}  // namespace palpate

// What is said about the contact of one matrix: a state, and a lamp.
#pragma once

#include <optional>
#include <string_view>

namespace palpate {

enum class SlipState {
  // No statement is possible: the contact is too small, or neither hypothesis fits.
  kInvalid,
  // No significant motion.
  kStill,
  // Motion no larger than that of a resting contact whose load changes as fast or whose joints move
  // as much.
  kLoading,
  kLoadShift,  // the load went to another place, the contact stayed: p_moved < 0.25
  kAmbiguous,  // 0.25 .. 0.75: the shape doesn't tell; or not confirmed yet
  kSlip,       // p_moved > 0.75, or an alarm
};
inline constexpr double kMaxStillScore = 0.25;  // p_moved
inline constexpr double kMinMotionScore = 0.75;

// "invalid", "still", "loading", "load_shift", "ambiguous", "slip"
std::string_view nameOf(SlipState state) noexcept;
std::optional<SlipState> slipStateNamed(std::string_view name) noexcept;

enum class SlipIndicator {
  kOff,            // switched off
  kNotComputable,  // no contact, too small a one, or it hasn't been touched long enough
  kReady,          // watches, and nothing slips
  kSlipping,
};
// "off", "not computable", "ready", "slipping"
std::string_view nameOf(SlipIndicator lamp) noexcept;

}  // namespace palpate

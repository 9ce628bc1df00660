// Slip state of the contact on one matrix, and the state of its indicator lamp in the window.
// SlipDetector determines both.
#pragma once

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
  // The load was redistributed and the contact did not move: p_moved < 0.25.
  kLoadShift,
  // p_moved is 0.25..0.75: the shape does not decide between motion and load shift; or slip is not
  // confirmed yet.
  kAmbiguous,
  // p_moved > 0.75, or an alarm.
  kSlip,
};
// Limits of p_moved for the states kLoadShift and kSlip.
inline constexpr double kMaxStillScore = 0.25;
inline constexpr double kMinMotionScore = 0.75;

// Returns "invalid", "still", "loading", "load_shift", "ambiguous" or "slip".
std::string_view nameOf(SlipState state) noexcept;

enum class SlipIndicator {
  // The detector is switched off.
  kOff,
  // There is no contact, it is too small, or it has not lasted long enough.
  kNotComputable,
  // The detector works and reports no slip.
  kReady,
  kSlipping,
};
// Returns "off", "not computable", "ready" or "slipping".
std::string_view nameOf(SlipIndicator indicator) noexcept;

}  // namespace palpate

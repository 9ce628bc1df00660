// Checks whether a hand can have given joint angles: one per axis, finite, and within the range of
// motion.
#pragma once

#include <string>
#include <vector>

#include <palpate/model/hand_description.h>

namespace palpate {

// A real joint can be up to a few hundredths of a degree beyond its range, and joints are
// calibrated by hand.
constexpr double kJointRangeToleranceDeg = 1.0;

// Result of the check of joint angles.
enum class AngleValidity {
  kValid,
  // A pose can be computed, but a real hand cannot have it.
  kOutOfRange,
  // The number of angles is wrong, or an angle is not finite.
  kUnusable
};

// The result with its explanation.
struct AnglesCheck {
  AngleValidity state = AngleValidity::kValid;
  // Describes the problem and names the axis; empty when the angles are valid.
  std::string problem;
};

// Checks the angles; never throws because of their values.
AnglesCheck checkAngles(const std::vector<double>& anglesDeg,
                        const std::vector<AxisDescription>& axes,
                        double toleranceDeg = kJointRangeToleranceDeg);

}  // namespace palpate

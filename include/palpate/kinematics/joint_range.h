// Whether joint angles can be those of a hand: as many as it has axes, finite, within its range of
// motion.
#pragma once

#include <string>
#include <vector>

#include <palpate/model/hand_description.h>

namespace palpate {

// A real joint stands up to a few hundredths of a degree beyond its range, and was calibrated by
// hand.
constexpr double kJointRangeToleranceDeg = 1.0;

enum class AngleValidity {
  kValid,
  kOutOfRange,  // a pose can be computed, but no hand of this kind has it
  kUnusable     // wrong number of angles, or not finite
};

struct AnglesCheck {
  AngleValidity state = AngleValidity::kValid;
  std::string problem;  // what is wrong with which axis; empty when fine
};

// Never throws for what the angles are.
AnglesCheck checkAngles(const std::vector<double>& anglesDeg,
                        const std::vector<AxisDescription>& axes,
                        double toleranceDeg = kJointRangeToleranceDeg);

}  // namespace palpate

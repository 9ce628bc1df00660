#include "palpate/kinematics/joint_range.h"

#include <cmath>

#include "palpate/core/number_text.h"

namespace palpate {

AnglesCheck checkAngles(const std::vector<double>& anglesDeg,
                        const std::vector<AxisDescription>& axes,
                        double toleranceDeg) {
  if (anglesDeg.size() != axes.size())
    return {AngleValidity::kUnusable,
            std::to_string(anglesDeg.size()) + " joint angles for " + std::to_string(axes.size()) +
                " axes"};
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (!std::isfinite(anglesDeg[i]))
      return {AngleValidity::kUnusable, "angle of axis " + std::to_string(i) + " is not a number"};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const AxisDescription& axis = axes[i];
    if (anglesDeg[i] < axis.minimumDeg - toleranceDeg ||
        anglesDeg[i] > axis.maximumDeg + toleranceDeg)
      return {AngleValidity::kOutOfRange,
              "axis " + std::to_string(i) + " (" + axis.name + ") at " +
                  numberText(std::round(100.0 * anglesDeg[i]) / 100.0) + " degrees; its range is " +
                  numberText(axis.minimumDeg) + ".." + numberText(axis.maximumDeg)};
  }
  return {};
}

}  // namespace palpate

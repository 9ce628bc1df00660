#include "palpate/slip/principal_axis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpate {
namespace {

// Rounding leaves about 1e-15 of the moments in values that should be 0.
constexpr double kRounding = 1e-12;

double skewness(double third, double second) {
  return std::abs(second) > 0.001 ? third / (second * std::sqrt(second)) : 0.0;
}

}  // namespace

PrincipalAxis principalAxis(const ContactMoments& moments) noexcept {
  PrincipalAxis axis;
  if (moments.active == 0) return axis;
  const double difference = moments.mu20 - moments.mu02;
  const double root = std::sqrt(difference * difference + 4.0 * moments.mu11 * moments.mu11);
  const double sum = moments.mu20 + moments.mu02;
  axis.lambda1 = std::max(0.5 * (sum + root), 0.0);
  axis.lambda2 = std::max(0.5 * (sum - root), 0.0);
  if (axis.lambda1 > kRounding) {
    const double ratio = axis.lambda2 / axis.lambda1;
    axis.eccentricity = std::sqrt(1.0 - ratio);
    axis.studyEccentricity = std::sqrt(1.0 - ratio * ratio);
  }
  // For a contact parallel to an axis of the matrix, rounding alone would decide between 0 and 180
  // deg.
  const double small = kRounding * std::max(sum, 1.0);
  if (std::abs(moments.mu11) <= small) {
    axis.orientationDeg = difference < -small ? 90.0 : 0.0;
  } else {
    axis.orientationDeg =
        0.5 * std::atan2(2.0 * moments.mu11, difference) * 180.0 / std::numbers::pi;
    if (axis.orientationDeg < 0.0) axis.orientationDeg += 180.0;
    if (axis.orientationDeg >= 180.0) axis.orientationDeg = 0.0;
  }
  axis.skewX = skewness(moments.mu30, moments.mu20);
  axis.skewY = skewness(moments.mu03, moments.mu02);
  return axis;
}

}  // namespace palpate

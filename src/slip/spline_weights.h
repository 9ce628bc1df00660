// Weights of the cubic B-spline and their derivatives; KeyFrame and LearnedSurface evaluate their
// surfaces with them.
#pragma once

#include <Eigen/Core>

namespace palpate::spline {

using SplineWeights = Eigen::Array<float, 4, 1>;

// Weights of the four knots around a place: one before, the last at or before it, and two after it.
// t = 0..1 is the distance from the second knot.
inline SplineWeights weights(float t) noexcept {
  const float s = 1.0F - t;
  const float t2 = t * t;
  const float s2 = s * s;
  return SplineWeights(
             s2 * s, 4.0F - 6.0F * t2 + 3.0F * t2 * t, 4.0F - 6.0F * s2 + 3.0F * s2 * s, t2 * t) *
         (1.0F / 6.0F);
}
// Derivatives of the weights, per distance of knots.
inline SplineWeights slopes(float t) noexcept {
  const float s = 1.0F - t;
  return SplineWeights(
      -0.5F * s * s, 1.5F * t * t - 2.0F * t, -1.5F * s * s + 2.0F * s, 0.5F * t * t);
}

}  // namespace palpate::spline

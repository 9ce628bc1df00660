// Principal axis, eccentricity and skewness of a contact, computed from its moments.
// RotationTracker follows the axis over the frames.
//
//   lambda1,2 = (mu20 + mu02)/2 +- sqrt((mu20 - mu02)^2 + 4 mu11^2)/2,
//   theta = 1/2 atan2(2 mu11, mu20 - mu02)
// Angles are measured from +x (right) towards +y (down): clockwise on the screen.
#pragma once

#include <palpate/slip/contact_moments.h>

namespace palpate {

struct PrincipalAxis {
  // Angle of the axis, 0 <= angle < 180; 0 for a contact without a direction.
  double orientationDeg = 0.0;
  // Variance along the axis (the larger one) and across it [taxels^2].
  double lambda1 = 0.0;
  double lambda2 = 0.0;
  // sqrt(1 - lambda2/lambda1): 0 for a round contact, 1 for a line.
  double eccentricity = 0.0;
  // The study's definition sqrt(1 - (lambda2/lambda1)^2); its limit of 0.6 refers to this value.
  double studyEccentricity = 0.0;
  // Skewness mu30 / mu20^1.5 and mu03 / mu02^1.5; 0 where the second moment is below 0.001.
  double skewX = 0.0;
  double skewY = 0.0;
};

PrincipalAxis principalAxis(const ContactMoments& moments) noexcept;

}  // namespace palpate

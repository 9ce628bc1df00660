// How a contact lies: principal axis, eccentricity and skewness from its moments.
//
//   lambda1,2 = (mu20 + mu02)/2 +- sqrt((mu20 - mu02)^2 + 4 mu11^2)/2,
//   theta = 1/2 atan2(2 mu11, mu20 - mu02)
// Angles from +x (right) towards +y (down): clockwise on the screen.
#pragma once

#include <palpate/slip/contact_moments.h>

namespace palpate {

struct PrincipalAxis {
  double orientationDeg = 0.0;  // 0 <= .. < 180; 0 for what has no direction
  double lambda1 = 0.0;         // variance along the axis [taxels^2], the larger one
  double lambda2 = 0.0;         // and across
  double eccentricity = 0.0;    // sqrt(1 - lambda2/lambda1): 0 round .. 1 a line
  // sqrt(1 - (lambda2/lambda1)^2), the study's: its limit of 0.6 belongs to this one.
  double studyEccentricity = 0.0;
  double skewX = 0.0;  // mu30 / mu20^1.5; 0 where mu20 is below 0.001
  double skewY = 0.0;
};

PrincipalAxis principalAxis(const ContactMoments& moments) noexcept;

}  // namespace palpate

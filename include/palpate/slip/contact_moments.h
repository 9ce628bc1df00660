// Image moments of the values of one matrix: load, position and shape of the contact. The slip
// methods and the principal axis are computed from them.
//
// x = column (right), y = row (down), in taxels; the taxel in column 0 and row 0 is at (0, 0). Only
// active taxels (value > 0) are summed. m_pq = sum x^p y^q f are the raw moments, mu_pq the central
// moments about the centroid, divided by m_00.
#pragma once

#include <palpate/model/tactile_frame.h>

namespace palpate {

struct ContactMoments {
  // Number of active taxels (value > 0).
  int active = 0;
  // Load m_00 [counts]. If it is 0, nothing is touched and all other values are 0.
  double sum = 0.0;
  // Centroid (m_10/m_00, m_01/m_00) [taxels].
  double x = 0.0;
  double y = 0.0;
  // Central moments, normalised to a load of 1: second moments [taxels^2], third moments
  // [taxels^3].
  double mu20 = 0.0;
  double mu11 = 0.0;
  double mu02 = 0.0;
  double mu30 = 0.0;
  double mu03 = 0.0;
};

// Computes the moments of a matrix of up to 256 x 256 taxels. A value that is not a number counts
// as not active.
ContactMoments contactMoments(const ConstMatrixMap& matrix) noexcept;

// Principal axis, eccentricity and skewness of a contact, computed from its moments.
// RotationTracker follows the axis over the frames.
//
//   lambda1,2 = (mu20 + mu02)/2 +- sqrt((mu20 - mu02)^2 + 4 mu11^2)/2,
//   theta = 1/2 atan2(2 mu11, mu20 - mu02)
// Angles are measured from +x (right) towards +y (down): clockwise on the screen.
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

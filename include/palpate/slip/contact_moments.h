// Moments of what one matrix feels: where the contact is, how it lies, how far it stretches.
//
// x = column (right), y = row (down), in taxels; the taxel in column 0 and row 0 lies at (0, 0).
// Only values > 0 count: an active taxel. m_pq = sum x^p y^q f, mu_pq the same around the centroid,
// divided by m_00.
#pragma once

#include <palpate/model/tactile_frame.h>

namespace palpate {

struct ContactMoments {
  int active = 0;    // taxels > 0
  double sum = 0.0;  // m_00 [counts]; 0: nothing is touched, and all that follows is 0
  double x = 0.0;    // centroid m_10/m_00, m_01/m_00 [taxels]
  double y = 0.0;
  double mu20 = 0.0;  // central, normalised to a sum of 1 [taxels^2, taxels^3]
  double mu11 = 0.0;
  double mu02 = 0.0;
  double mu30 = 0.0;
  double mu03 = 0.0;
};

// Any size up to 256 x 256. What isn't a number counts as not active.
ContactMoments contactMoments(const ConstMatrixMap& matrix) noexcept;

}  // namespace palpate

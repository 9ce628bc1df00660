// How one signal goes with another: correlation and the line of least squares, for the XY plot of
// the selection in the timeline.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace palpate {

// Of the pairs of which both values are finite. A number is NaN where there are too few pairs for
// it, or where x (or y) doesn't change.
struct LinearRelation {
  std::size_t count = 0;
  double correlation = std::numeric_limits<double>::quiet_NaN();  // Pearson's r, -1..1
  // y = intercept + slope x.
  double slope = std::numeric_limits<double>::quiet_NaN();      // [unit of y / unit of x]
  double intercept = std::numeric_limits<double>::quiet_NaN();  // [unit of y]
  // Standard deviation of the residuals with n - 2; needs three pairs [unit of y].
  double residualSd = std::numeric_limits<double>::quiet_NaN();
};

// Throws std::invalid_argument when the numbers of values differ.
LinearRelation linearRelation(std::span<const double> x, std::span<const double> y);

}  // namespace palpate

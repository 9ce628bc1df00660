// Computes quantiles of Student's t distribution, for intervals of fitted parameters.
#pragma once

namespace palpate {

// Returns the 97.5 % quantile: mean +- this many standard deviations contain 95 %. `dof` are the
// degrees of freedom, also fractions; NaN below 1.
double studentQuantile975(double dof);

}  // namespace palpate

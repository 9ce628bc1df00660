// Quantiles of Student's t distribution, for intervals of fitted parameters.
#pragma once

namespace palpate {

// 97.5 % quantile: mean +- this many standard deviations hold 95 %. `dof` degrees of freedom, whole
// or not; below 1: NaN.
double studentQuantile975(double dof);

}  // namespace palpate

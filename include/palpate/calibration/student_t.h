// Quantiles of Student's t distribution, for intervals of fitted parameters.
#pragma once

namespace palpate {

// 97.5 % quantile: mean +- this many standard deviations hold 95 %. `dof` degrees of freedom; below 1: NaN. Within
// 2e-4 relative (Cornish-Fisher series from 5 on, closed forms and linear between whole numbers below).
double studentQuantile975(double dof);

}  // namespace palpate

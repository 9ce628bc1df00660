// Standardisation: subtracts the mean of each feature and divides by its standard deviation, both
// estimated from the samples it was fitted to (divisor n; study, 6.8.1). A constant feature becomes
// 0 for every sample.
#pragma once

#include <Eigen/Core>

namespace palpate {

struct Standardisation {
  Eigen::VectorXd mean;   // per feature, in its unit
  Eigen::VectorXd scale;  // 1 / sd; 0 where sd is below 1e-12 of the largest magnitude

  // Of samples x features. Throws std::invalid_argument when there is no sample.
  static Standardisation of(const Eigen::MatrixXd& x);
  // Samples x features in, the same shape out. Throws std::invalid_argument (another number of
  // features).
  Eigen::MatrixXd apply(const Eigen::MatrixXd& x) const;
  Eigen::VectorXd applyRow(const Eigen::VectorXd& row) const;
};

}  // namespace palpate

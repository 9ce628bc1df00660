// Standardisation: subtracts the mean of each feature and divides by its standard deviation, both
// estimated from the samples it was fitted to (divisor n; study, 6.8.1). A constant feature becomes
// 0 for every sample. It is the first stage of ClassifierPipeline.
#pragma once

#include <Eigen/Core>

namespace palpate {

struct Standardisation {
  // Mean per feature, in the unit of the feature.
  Eigen::VectorXd mean;
  // 1 / standard deviation; 0 where the standard deviation is below 1e-12 of the largest magnitude.
  Eigen::VectorXd scale;

  // Fits to samples x features. Throws std::invalid_argument when there is no sample.
  static Standardisation of(const Eigen::MatrixXd& x);
  // Standardises samples x features; the result has the same shape. Throws std::invalid_argument
  // (another number of features).
  Eigen::MatrixXd apply(const Eigen::MatrixXd& x) const;
};

}  // namespace palpate

// Classifier with one Gaussian distribution per class (regularised quadratic discriminant analysis;
// Friedman 1989, "Regularized discriminant analysis", J. American Statistical Association 84). All
// classes have the same prior probability. ClassifierPipeline uses it for qda, lda and the novelty
// scores.
// The covariance matrix of a class is computed in three steps:
//   C_c = (1 - pooledFraction) S_c + pooledFraction S_w
//   C_c: off-diagonal elements times correlationScale
//   C_c = C_c + extraVariance diag(S_w) + ridge
// With pooledFraction 1 this is the linear discriminant rule: the class with the nearest mean in
// Mahalanobis distance.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace palpate {

struct ClassGaussianOptions {
  // Fraction of S_w, 0..1; a class with one sample uses S_w only.
  double pooledFraction = 0.5;
  double correlationScale = 1.0;  // 0..1
  // Variance added for other sessions, as a fraction of the pooled variance, >= 0.
  double extraVariance = 0.0;
  // As a fraction of the mean of the pooled variances, 1e-9..1.
  double ridge = 1e-3;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct GaussianClassifier {
  struct Class {
    // Whether the class had samples.
    bool present = false;
    Eigen::VectorXd mean;
    // Lower triangular W: |W (x - mean)|^2 is the squared Mahalanobis distance.
    Eigen::MatrixXd whitening;
    // Of the covariance matrix.
    double logDeterminant = 0.0;
  };
  std::vector<Class> classes;

  // Fits to samples x features and their classes 0..numClasses-1. Throws std::invalid_argument
  // (sizes, labels, no class with two samples).
  static GaussianClassifier of(const Eigen::MatrixXd& x,
                               const std::vector<int>& y,
                               std::size_t numClasses,
                               const ClassGaussianOptions& options = {});
  // ln p(x | c) per sample and class, without the constant -d/2 ln 2 pi; -infinity for a class
  // without samples.
  Eigen::MatrixXd logDensity(const Eigen::MatrixXd& x) const;
  // Squared Mahalanobis distance to the nearest class, per sample.
  Eigen::VectorXd nearestSquaredDistance(const Eigen::MatrixXd& x) const;
};

}  // namespace palpate

// A Gaussian per class (regularised quadratic discriminant analysis; Friedman 1989, "Regularized
// discriminant analysis", J. American Statistical Association 84). Classes are equally likely
// beforehand.
//   C_c = (1 - pooledFraction) S_c + pooledFraction S_w;  off-diagonal elements times
//   correlationScale;
//         + extraVariance diag(S_w);  + ridge
// With pooledFraction 1 it is the linear discriminant rule: the nearest mean in Mahalanobis
// distance.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace palpate {

struct ClassGaussianOptions {
  double pooledFraction = 0.5;    // 0..1; a class with one sample takes S_w whole
  double correlationScale = 1.0;  // 0..1
  double extraVariance = 0.0;     // >= 0, of the pooled variance: what other days add
  double ridge = 1e-3;            // times the mean of the pooled variances; 1e-9 .. 1

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct GaussianClassifier {
  struct Class {
    bool present = false;  // had samples
    Eigen::VectorXd mean;
    // lower triangular W: |W (x - mean)|^2 is the squared Mahalanobis distance
    Eigen::MatrixXd whitening;
    double logDeterminant = 0.0;  // of the covariance
  };
  std::vector<Class> classes;

  // Samples x features, classes 0..numClasses-1. Throws std::invalid_argument (sizes, labels, no
  // class with two samples).
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

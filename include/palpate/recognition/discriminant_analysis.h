// Linear discriminant analysis: the directions w that separate the classes best relative to the
// scatter within the classes,
//   S_b w = lambda S_w w,   largest lambda first,   w' S_w w = 1   (study, 6.8.4, corrected),
//   S_w = 1/(n - C) sum_c sum_{i in c} (x_i - m_c)(x_i - m_c)',
//   S_b = 1/(C - 1) sum_c n_c (m_c - m)(m_c - m)'.
// S_w is always regularised, because features may be multiples of others (six of the study's 54
// are): it is shrunk towards a multiple of the identity (Ledoit, Wolf 2004, "A well-conditioned
// estimator for large-dimensional covariance matrices", J. Multivariate Analysis 88), then a ridge
// is added.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <palpate/core/option_check.h>

namespace palpate {

struct DiscriminantOptions {
  // Number of directions; 0 or more than min(features, classes - 1): as many as there are.
  std::size_t components = 0;
  // Added to the diagonal of S_w as a fraction of the mean of that diagonal.
  static constexpr OptionRange kRidge{1e-6, 1.0};
  double ridge = 1e-6;
  // Fraction of the identity in S_w; empty: by the formula of Ledoit and Wolf.
  static constexpr OptionRange kShrinkage{0.0, 1.0};
  std::optional<double> shrinkage = 0.0;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct DiscriminantAnalysis {
  // Mean of all samples.
  Eigen::VectorXd mean;
  // Features x components; the largest entry of each direction is positive.
  Eigen::MatrixXd directions;
  // Eigenvalue lambda of each direction, descending, >= 0.
  Eigen::VectorXd separation;
  // The shrinkage that was used.
  double shrinkage = 0.0;

  // Fits to samples x features (standardised) and their classes 0..numClasses-1; classes without a
  // sample are ignored. Throws std::invalid_argument (sizes; fewer than two classes; no class with
  // two samples; options).
  static DiscriminantAnalysis of(const Eigen::MatrixXd& x,
                                 const std::vector<int>& y,
                                 const DiscriminantOptions& options = {});
  // Projects samples; returns samples x components.
  Eigen::MatrixXd apply(const Eigen::MatrixXd& x) const;
  // Weight of each feature: sqrt(sum_k separation_k directions(j, k)^2), scaled to a sum of 1.
  Eigen::VectorXd featureWeights() const;
};

// Scatter of samples about the means of their classes.
struct WithinScatter {
  // Classes x features; 0 where a class has no sample.
  Eigen::MatrixXd means;
  // Number of samples per class.
  std::vector<std::size_t> counts;
  // Samples x features: each sample minus the mean of its class.
  Eigen::MatrixXd residuals;
  // Pooled within-class covariance matrix S_w.
  Eigen::MatrixXd covariance;
  // Number of samples minus number of classes with samples.
  std::size_t degreesOfFreedom = 0;
};
// Throws std::invalid_argument (sizes, labels below 0, n <= number of classes with samples).
WithinScatter withinScatter(const Eigen::MatrixXd& x, const std::vector<int>& y);
// Fraction of the identity by Ledoit and Wolf for residuals (rows with mean 0), 0..1; 1 where they
// are all 0.
double ledoitWolfShrinkage(const Eigen::MatrixXd& residuals);
// Returns (1 - share) S + share mean(diag S) I + ridge mean(diag S) I; if S is 0, ridge I.
Eigen::MatrixXd regularised(const Eigen::MatrixXd& covariance, double share, double ridge);

}  // namespace palpate

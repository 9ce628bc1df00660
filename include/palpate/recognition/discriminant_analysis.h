// Linear discriminant analysis: the directions w in which classes lie apart most, measured by how
// they scatter,
//   S_b w = lambda S_w w,   largest lambda first,   w' S_w w = 1   (study, 6.8.4, corrected),
//   S_w = 1/(n - C) sum_c sum_{i in c} (x_i - m_c)(x_i - m_c)',
//   S_b = 1/(C - 1) sum_c n_c (m_c - m)(m_c - m)'.
// S_w is always regularised, since features may be multiples of others (six of the study's 54 are):
// shrunk towards a multiple of the identity (Ledoit, Wolf 2004, "A well-conditioned estimator for
// large-dimensional covariance matrices", J. Multivariate Analysis 88), then a ridge.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace palpate {

struct DiscriminantOptions {
  // How many directions; 0: as many as there are (min of features and classes - 1). More than that:
  // those there are.
  std::size_t components = 0;
  double ridge = 1e-6;  // added to the diagonal of S_w, times the mean of that diagonal; 1e-6 .. 1
  // Share of the identity in S_w, 0..1; nothing: by Ledoit and Wolf's formula.
  std::optional<double> shrinkage = 0.0;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct DiscriminantAnalysis {
  Eigen::VectorXd mean;        // of all samples
  Eigen::MatrixXd directions;  // features x components; the largest entry of each is positive
  Eigen::VectorXd separation;  // lambda of each, descending, >= 0
  double shrinkage = 0.0;      // that was used

  // Fits to samples x features (standardised) and their classes 0..numClasses-1; classes without a
  // sample don't count. Throws std::invalid_argument (sizes; fewer than two classes; no class with
  // two samples; options).
  static DiscriminantAnalysis of(const Eigen::MatrixXd& x,
                                 const std::vector<int>& y,
                                 const DiscriminantOptions& options = {});
  Eigen::MatrixXd apply(const Eigen::MatrixXd& x) const;  // samples x components
  Eigen::VectorXd applyRow(const Eigen::VectorXd& row) const;
  // Of each feature: sqrt(sum_k separation_k directions(j, k)^2), scaled to a sum of 1.
  Eigen::VectorXd featureWeights() const;
};

// How samples scatter around the means of their classes.
struct WithinScatter {
  Eigen::MatrixXd means;             // classes x features; 0 where a class has no sample
  std::vector<std::size_t> counts;   // samples per class
  Eigen::MatrixXd residuals;         // samples x features: x - mean of its class
  Eigen::MatrixXd covariance;        // S_w
  std::size_t degreesOfFreedom = 0;  // n - classes with samples
};
// Throws std::invalid_argument (sizes, labels below 0, n <= number of classes with samples).
WithinScatter withinScatter(const Eigen::MatrixXd& x, const std::vector<int>& y);
// Ledoit and Wolf's share of the identity for residuals (rows, of mean 0), 0..1; 1 where they are
// all 0.
double ledoitWolfShrinkage(const Eigen::MatrixXd& residuals);
// (1 - share) S + share mean(diag S) I + ridge mean(diag S) I; where S is 0: ridge I.
Eigen::MatrixXd regularised(const Eigen::MatrixXd& covariance, double share, double ridge);

}  // namespace palpate

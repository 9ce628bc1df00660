// Linear support vector machine, one against one (study, 6.8.2): between every pair of classes
// there is a hyperplane w.x + b that minimises |w|^2 / 2 + C sum of max(0, 1 - y (w.x + b)); b is
// not penalised.
// The `ml` module of OpenCV fits the pairs (single precision kernel). It provides neither decision
// values for several classes nor probabilities, so that the votes are computed here: each pair
// votes for one of its classes, and the class with the most votes wins. Of classes with equal
// votes, the one with the larger sum of distances on its own side of its hyperplanes wins.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <palpate/core/option_check.h>

namespace palpate {

struct SvmOptions {
  // Cost C of a sample on the wrong side.
  static constexpr OptionRange kC{1e-6, 1e9};
  double c = 100.0;
  // Tolerance of the optimality conditions (eps of LIBSVM), > 0.
  double tolerance = 1e-3;
  // Largest number of iterations per pair, >= 1; the solution is then used as it is.
  int maxIterations = 100000;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct SupportVectorMachine {
  std::size_t numClasses = 0;
  // Pairs (first, second) of classes with samples, first < second.
  std::vector<std::pair<int, int>> pairs;
  Eigen::MatrixXd weights;  // pairs x features
  Eigen::VectorXd offsets;  // per pair

  // Fits to samples x features (standardised) and their classes 0..numClasses-1; a class without
  // samples is in no pair. Throws std::invalid_argument (sizes, labels, fewer than two classes with
  // samples, options).
  static SupportVectorMachine of(const Eigen::MatrixXd& x,
                                 const std::vector<int>& y,
                                 std::size_t numClasses,
                                 const SvmOptions& options = {});
  // Decision values, samples x pairs; a value above 0 is for the first class of the pair.
  Eigen::MatrixXd decisions(const Eigen::MatrixXd& x) const;
  // Votes of each class for one sample, plus a value below 1/2 that orders classes with equal votes
  // by their distance from the hyperplanes.
  Eigen::VectorXd votes(const Eigen::VectorXd& decisions) const;
  // Weight of each feature: root mean square of its component over the unit normals of the pairs,
  // scaled to a sum of 1.
  Eigen::VectorXd featureWeights() const;
};

}  // namespace palpate

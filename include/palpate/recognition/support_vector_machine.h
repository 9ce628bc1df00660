// Linear support vector machine, one against one (study, 6.8.2): a hyperplane w.x + b between every
// pair of classes that minimises |w|^2 / 2 + C sum of max(0, 1 - y (w.x + b)), b not penalised.
// OpenCV's `ml` solves the pairs (single precision kernel); it has neither decision values of
// several classes nor probabilities: the votes are ours. A class gets a vote of each of its pairs;
// the most votes win, and of several with as many that which lies farther on its own side of its
// planes, summed over all of them.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace palpate {

struct SvmOptions {
  double c = 100.0;  // cost of a sample on the wrong side, > 0
  // how far the conditions of the optimum may be missed (LIBSVM's eps), > 0
  double tolerance = 1e-3;
  int maxIterations = 100000;  // of one pair, >= 1; then it is taken as it is

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct SupportVectorMachine {
  std::size_t numClasses = 0;
  // (first, second), first < second, of classes with samples
  std::vector<std::pair<int, int>> pairs;
  Eigen::MatrixXd weights;  // pairs x features
  Eigen::VectorXd offsets;  // per pair

  // Samples x features (standardised), classes 0..numClasses-1; one without samples takes part in
  // no pair. Throws std::invalid_argument (sizes, labels, fewer than two classes with samples,
  // options).
  static SupportVectorMachine of(const Eigen::MatrixXd& x,
                                 const std::vector<int>& y,
                                 std::size_t numClasses,
                                 const SvmOptions& options = {});
  // Per sample and pair; above 0 speaks for the first class of the pair.
  Eigen::MatrixXd decisions(const Eigen::MatrixXd& x) const;
  // Votes of each class for one sample, plus a value below 1/2 that orders classes with equal votes
  // by their distance from the hyperplanes.
  Eigen::VectorXd votes(const Eigen::VectorXd& decisions) const;
  // Of each feature: root mean square of its weight over the pairs' unit normals, scaled to a sum
  // of 1.
  Eigen::VectorXd featureWeights() const;
};

}  // namespace palpate

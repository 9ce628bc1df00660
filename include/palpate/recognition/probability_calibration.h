// Calibrates classifier scores to probabilities. The method is deterministic and uses test samples
// that were not used for training (docs/notes/recognition.md). ClassifierPipeline uses it.
//   pairs     P(first) = 1 / (1 + exp(a f + b)): Platt 2000, in the form of Lin, Lin, Weng 2007, "A
//             note on Platt's probabilistic outputs for support vector machines", Machine Learning
//             68
//   classes   from the pairs: Wu, Lin, Weng 2004, "Probability estimates for multi-class
//             classification by pairwise coupling", J. Machine Learning Research 5, second method
//   densities p(c) ~ exp(t ln p(x | c)): one exponent for all classes (temperature scaling)
#pragma once

#include <vector>

#include <Eigen/Core>

namespace palpate {

// Calibration of one pair of classes: P(first) = 1 / (1 + exp(a f + b)) for the decision value f.
struct Sigmoid {
  double a = -1.0;
  double b = 0.0;
  // P(first) for a decision value, 0..1; never exactly 0 or 1 for finite decisions up to 700 / |a|.
  double at(double decision) const noexcept;
};

// Fits a sigmoid to the decision values of one pair on samples of its two classes. Throws
// std::invalid_argument (sizes, no samples).
Sigmoid fitSigmoid(const std::vector<double>& decisions, const std::vector<bool>& first);

// Combines pairwise probabilities into class probabilities that sum to 1. `pairwise(i, j)` is P(i |
// i or j); entries (i, j) and (j, i) sum to 1, the diagonal is not used. Throws
// std::invalid_argument (not square, empty).
Eigen::VectorXd coupleProbabilities(const Eigen::MatrixXd& pairwise);

// Returns exp(exponent score) of each row, scaled to a sum of 1; a score of -infinity gives 0.
Eigen::MatrixXd softmaxRows(const Eigen::MatrixXd& scores, double exponent = 1.0);

// Returns the exponent, 0.01..50, that maximises the likelihood of the true classes of `scores`
// (samples x classes, log densities). Rows whose true class has no finite score are ignored; 1 if
// no row is left. Throws std::invalid_argument (sizes).
double fitExponent(const Eigen::MatrixXd& scores, const std::vector<int>& y);

}  // namespace palpate

// Calibrates classifier scores to probabilities. The method is deterministic and uses test samples
// that were not used for training (docs/recognition.md).
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

struct Sigmoid {
  double a = -1.0;
  double b = 0.0;
  double at(double decision)
      const noexcept;  // 0..1, never exactly either for finite decisions up to 700 / |a|
};

// From decisions of one pair on samples of its two classes. Throws std::invalid_argument (sizes, no
// samples).
Sigmoid fitSigmoid(const std::vector<double>& decisions, const std::vector<bool>& first);

// `pairwise(i, j)`: P(i | i or j); entries (i, j) and (j, i) sum to 1, the diagonal isn't read.
// Gives probabilities that sum to
// 1. Throws std::invalid_argument (not square, empty).
Eigen::VectorXd coupleProbabilities(const Eigen::MatrixXd& pairwise);

// exp(t s) of each row, scaled to a sum of 1; -infinity gives 0.
Eigen::MatrixXd softmaxRows(const Eigen::MatrixXd& scores, double exponent = 1.0);

// The exponent, 0.01 .. 50, under which the true classes of `scores` (samples x classes,
// logarithms) are most likely. Rows whose true class has no finite score don't count; 1 where none
// does. Throws std::invalid_argument (sizes).
double fitExponent(const Eigen::MatrixXd& scores, const std::vector<int>& y);

}  // namespace palpate

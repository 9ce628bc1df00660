// General nonlinear least squares by Levenberg-Marquardt (Ceres Solver): minimises sum r_i(x)^2, or
// a robust loss of the residuals, within bounds. Derivatives are extrapolated central differences
// unless they are given. The fit of loading steps uses it. The tests solve all 27 nonlinear
// problems of NIST StRD.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace palpate {

// The loss rho(r^2) of a residual r with the scale a. The derivative of rho is the weight of the
// residual.
enum class LeastSquaresLoss {
  kSquares,  // r^2; weight 1
  kHuber,    // r^2 up to |r| = a, then 2 a |r| - a^2; weight a / |r|
  kCauchy,   // a^2 log(1 + r^2 / a^2); weight 1 / (1 + r^2 / a^2)
};

// The function to minimise.
struct LeastSquaresProblem {
  std::size_t numResiduals = 0;  // >= number of parameters
  // Writes the residuals at x. They are not defined at x when it returns false or writes a value
  // that is not finite.
  std::function<bool(std::span<const double> x, std::span<double> residuals)> residuals;
  // Writes d r_i / d x_j to [i * parameters + j]; may be empty.
  std::function<bool(std::span<const double> x, std::span<double> jacobian)> jacobian = {};
  // Bounds of every parameter; empty means none.
  Eigen::VectorXd lowerBounds = {}, upperBounds = {};
  LeastSquaresLoss loss = LeastSquaresLoss::kSquares;
  // The scale a of the loss [unit of the residuals], > 0.
  double lossScale = 1.0;
};

struct LeastSquaresOptions {
  int maxIterations = 1000;  // >= 1
  // The search ends when a step promises to reduce the sum by less than this share, or moves x by
  // less than this share; > 0.
  double tolerance = 1e-16;
  // Initial sizes of the trust region, > 0, at least one. The next size is tried when the previous
  // ones found no minimum, or one with dependent derivatives.
  std::vector<double> firstRadii = {1e4, 1.0, 1e-3};
  bool covariance = true;  // whether to compute the covariance
};

// Result of a minimisation.
struct LeastSquaresReport {
  Eigen::VectorXd x;
  // Sum of squares; with a robust loss, the sum of rho(r^2).
  double sumOfSquares = 0.0;
  double residualSd = 0.0;  // sqrt(sum of weighted squares / (n - p)); 0 when n = p
  // Covariance of x, linearised, scaled by residualSd^2; NaN when the derivatives are dependent.
  Eigen::MatrixXd covariance;
  // Weights of the residuals, from the loss; empty when they are not defined at x.
  std::vector<double> weights;
  bool converged = false;  // a minimum was found
  int iterations = 0;
  std::string message;  // why the search ended, one line
};

// Minimises the problem from `start`. Throws std::invalid_argument (sizes, a start that is not
// finite, bounds, loss, options). The report says when the data cause a problem (not defined at the
// start, no convergence).
LeastSquaresReport solveLeastSquares(const LeastSquaresProblem& problem,
                                     const Eigen::VectorXd& start,
                                     const LeastSquaresOptions& options = {});

// Returns (J^T W J)^-1 at x, where W are the weights of the loss: the covariance of x for residuals
// of unit variance. NaN when the derivatives are dependent or the model is not defined.
Eigen::MatrixXd unitCovariance(const LeastSquaresProblem& problem, const Eigen::VectorXd& x);

}  // namespace palpate

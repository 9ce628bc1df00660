// General nonlinear least squares by Levenberg-Marquardt (Ceres Solver): minimises sum r_i(x)^2, or
// a robust loss of the residuals, within bounds. Derivatives by extrapolated central differences
// unless they are given. The fit of loading steps uses it; proof: all 27 nonlinear problems of NIST
// StRD.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace palpate {

// rho(r^2) of a residual r and the scale a, whose derivative is the weight of the residual.
enum class LeastSquaresLoss {
  kSquares,  // r^2; weight 1
  kHuber,    // r^2 up to |r| = a, then 2 a |r| - a^2; weight a / |r|
  kCauchy,   // a^2 log(1 + r^2 / a^2); weight 1 / (1 + r^2 / a^2)
};

struct LeastSquaresProblem {
  std::size_t numResiduals = 0;  // >= number of parameters
  // Writes the residuals at x; false, or a value that is no number: not defined there.
  std::function<bool(std::span<const double> x, std::span<double> residuals)> residuals;
  // d r_i / d x_j at [i * parameters + j]; may be absent.
  std::function<bool(std::span<const double> x, std::span<double> jacobian)> jacobian = {};
  // Bounds of every parameter; empty: none.
  Eigen::VectorXd lowerBounds = {}, upperBounds = {};
  LeastSquaresLoss loss = LeastSquaresLoss::kSquares;
  double lossScale = 1.0;  // a of the loss [unit of the residuals], > 0
};

struct LeastSquaresOptions {
  int maxIterations = 1000;  // >= 1
  // Ends where a step promises less than this share of the sum, or moves x by less than this share;
  // > 0.
  double tolerance = 1e-16;
  // Trust regions to begin with, > 0, one at least. A later one is tried where no minimum was found
  // by those before, or one whose derivatives are dependent.
  std::vector<double> firstRadii = {1e4, 1.0, 1e-3};
  bool covariance = true;  // false: it stays empty
};

struct LeastSquaresReport {
  Eigen::VectorXd x;
  double sumOfSquares = 0.0;  // of a robust loss: sum of rho(r^2)
  double residualSd = 0.0;    // sqrt(sum of weighted squares / (n - p)); 0 where n = p
  // of x, linearised, scaled by residualSd^2; NaN where the derivatives are dependent
  Eigen::MatrixXd covariance;
  std::vector<double> weights;  // of the residuals, by the loss; empty: not defined at x
  bool converged = false;       // a minimum was found
  int iterations = 0;
  std::string message;  // what ended it, one line
};

// Throws std::invalid_argument (sizes, a start that is no number, bounds, loss, options). Trouble
// of the data (not defined at the start, no convergence) is told by the report.
LeastSquaresReport solveLeastSquares(const LeastSquaresProblem& problem,
                                     const Eigen::VectorXd& start,
                                     const LeastSquaresOptions& options = {});

// (J^T W J)^-1 at x, W the weights of the loss: the covariance of x for residuals of unit variance.
// NaN where the derivatives are dependent or the model isn't defined.
Eigen::MatrixXd unitCovariance(const LeastSquaresProblem& problem, const Eigen::VectorXd& x);

}  // namespace palpate

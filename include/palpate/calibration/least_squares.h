// General nonlinear least squares: minimises sum r_i(x)^2 by Levenberg-Marquardt (Ceres Solver),
// derivatives by extrapolated central differences unless they are given. Proof: all 27 nonlinear
// problems of NIST StRD.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include <Eigen/Core>

namespace palpate {

struct LeastSquaresProblem {
  std::size_t numResiduals = 0;  // >= number of parameters
  // Writes the residuals at x; false, or a value that is no number: not defined there.
  std::function<bool(std::span<const double> x, std::span<double> residuals)> residuals;
  // d r_i / d x_j at [i * parameters + j]; may be absent.
  std::function<bool(std::span<const double> x, std::span<double> jacobian)> jacobian = {};
};

struct LeastSquaresOptions {
  int maxIterations = 1000;  // >= 1
  // Ends where a step promises less than this share of the sum, or moves x by less than this share;
  // > 0.
  double tolerance = 1e-16;
};

struct LeastSquaresReport {
  Eigen::VectorXd x;
  double sumOfSquares = 0.0;
  double residualSd = 0.0;  // sqrt(sum / (n - p)); 0 where n = p
  // of x, linearised, scaled by residualSd^2; NaN where the derivatives are dependent
  Eigen::MatrixXd covariance;
  bool converged = false;  // a minimum was found
  int iterations = 0;
  std::string message;  // what ended it, one line
};

// Throws std::invalid_argument (sizes, a start that is no number, options). Trouble of the
// data (not defined at the start, no convergence) is told by the report.
LeastSquaresReport solveLeastSquares(const LeastSquaresProblem& problem,
                                     const Eigen::VectorXd& start,
                                     const LeastSquaresOptions& options = {});

}  // namespace palpate

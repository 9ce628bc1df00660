#include "palpate/calibration/least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/QR>
#include <ceres/ceres.h>
#include <glog/logging.h>

#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr double kLeastSquaresDependent = 1e-14;
// Of a difference, beside the parameter; and the least size of a parameter that it is taken of.
constexpr double kRelativeWidth = 5e-4;
constexpr double kLeastSize = 1e-12;

std::size_t sizeOf(const Eigen::VectorXd& x) { return static_cast<std::size_t>(x.size()); }

// What Ceres says belongs into the report, not onto a stream of the program.
void silenceCeres() {
  static const bool once = [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    return true;
  }();
  static_cast<void>(once);
}

bool evaluated(const LeastSquaresProblem& problem,
               std::span<const double> x,
               std::span<double> residuals) {
  return problem.residuals(x, residuals) &&
         std::all_of(residuals.begin(), residuals.end(), [](double r) { return std::isfinite(r); });
}

// Central differences of two widths, extrapolated: the error falls with the fourth power of the
// width, which lets it be wide (rounding: 1e-13 relative). Where the model isn't defined on both
// sides, nothing.
bool differences(const LeastSquaresProblem& problem,
                 std::span<const double> x,
                 std::span<double> jacobian) {
  const std::size_t p = x.size(), n = problem.numResiduals;
  std::vector<double> at(x.begin(), x.end());
  std::vector<double> values[4] = {std::vector<double>(n),
                                   std::vector<double>(n),
                                   std::vector<double>(n),
                                   std::vector<double>(n)};
  constexpr double kOffsets[4] = {2.0, 1.0, -1.0, -2.0};
  for (std::size_t j = 0; j < p; ++j) {
    const double width = kRelativeWidth * std::max(std::abs(x[j]), kLeastSize);
    for (int k = 0; k < 4; ++k) {
      at[j] = x[j] + kOffsets[k] * width;
      if (!evaluated(problem, at, values[k])) return false;
    }
    at[j] = x[j];
    for (std::size_t i = 0; i < n; ++i)
      jacobian[i * p + j] =
          (8.0 * (values[1][i] - values[2][i]) - (values[0][i] - values[3][i])) / (12.0 * width);
  }
  return true;
}

// One block of all parameters and residuals.
class WholeProblem final : public ceres::CostFunction {
 public:
  WholeProblem(const LeastSquaresProblem& problem, std::size_t numParameters)
      : problem_(problem), numParameters_(numParameters) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(numParameters));
    set_num_residuals(static_cast<int>(problem.numResiduals));
  }
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const std::span<const double> at(x[0], numParameters_);
    if (!evaluated(problem_, at, {residuals, problem_.numResiduals})) return false;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    const std::span<double> jacobian(jacobians[0], problem_.numResiduals * numParameters_);
    return problem_.jacobian ? problem_.jacobian(at, jacobian)
                             : differences(problem_, at, jacobian);
  }

 private:
  const LeastSquaresProblem& problem_;
  std::size_t numParameters_;
};

void requireLeastSquares(const LeastSquaresProblem& problem,
                         const Eigen::VectorXd& start,
                         const LeastSquaresOptions& options) {
  const auto refuse = [](const std::string& what) {
    throw std::invalid_argument("solveLeastSquares: " + what);
  };
  if (!problem.residuals) refuse("no residuals");
  if (start.size() == 0 || !start.allFinite()) refuse("the start must be numbers, one at least");
  if (problem.numResiduals < sizeOf(start))
    refuse(std::to_string(problem.numResiduals) + " residuals don't determine " +
           std::to_string(start.size()) + " parameters");
  if (options.maxIterations < 1) refuse("maxIterations must be at least 1");
  if (!(options.tolerance > 0.0)) refuse("tolerance must be above 0");
}

// (J^T J)^-1 by QR of the column-scaled derivatives.
Eigen::MatrixXd unitCovariance(Eigen::MatrixXd jacobian) {
  const Eigen::Index p = jacobian.cols();
  const Eigen::RowVectorXd size = jacobian.colwise().norm();
  const Eigen::MatrixXd unknown =
      Eigen::MatrixXd::Constant(p, p, std::numeric_limits<double>::quiet_NaN());
  if (!size.allFinite() || !(size.minCoeff() > 0.0)) return unknown;
  jacobian.array().rowwise() /= size.array();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(jacobian);
  const Eigen::MatrixXd r = qr.matrixQR().topRows(p).triangularView<Eigen::Upper>();
  if (!(r.diagonal().cwiseAbs().minCoeff() > kLeastSquaresDependent)) return unknown;
  const Eigen::MatrixXd inverse =
      r.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(p, p));
  return (inverse * inverse.transpose()).cwiseQuotient(size.transpose() * size);
}

ceres::Solver::Options solverOptions(const LeastSquaresOptions& options, double radius) {
  ceres::Solver::Options solver;
  solver.max_num_iterations = options.maxIterations;
  solver.function_tolerance = options.tolerance;
  solver.parameter_tolerance = options.tolerance;
  solver.gradient_tolerance = std::numeric_limits<double>::min();
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.logging_type = ceres::SILENT;
  solver.initial_trust_region_radius = radius;
  solver.num_threads = 1;  // the same result on every machine
  // A step into a place where the model isn't defined is taken back and shortened.
  solver.max_num_consecutive_invalid_steps = 50;
  return solver;
}

// One descent; how far its first step may go is the radius.
LeastSquaresReport descend(const LeastSquaresProblem& problem,
                           const Eigen::VectorXd& start,
                           const LeastSquaresOptions& options,
                           double radius) {
  const std::size_t p = sizeOf(start);
  LeastSquaresReport report;
  report.x = start;
  report.covariance.setConstant(
      start.size(), start.size(), std::numeric_limits<double>::quiet_NaN());
  ceres::Problem ceresProblem;
  ceresProblem.AddResidualBlock(new WholeProblem(problem, p), nullptr, report.x.data());
  ceres::Solver::Summary summary;
  ceres::Solve(solverOptions(options, radius), &ceresProblem, &summary);
  report.converged = summary.termination_type == ceres::CONVERGENCE;
  report.iterations = static_cast<int>(summary.iterations.size());
  report.message = summary.message.substr(0, summary.message.find('\n'));

  std::vector<double> residuals(problem.numResiduals), jacobian(problem.numResiduals * p);
  const std::span<const double> at(report.x.data(), p);
  report.sumOfSquares = report.residualSd = std::numeric_limits<double>::quiet_NaN();
  if (!evaluated(problem, at, residuals)) return report;
  report.sumOfSquares = Eigen::Map<const Eigen::VectorXd>(
                            residuals.data(), static_cast<Eigen::Index>(residuals.size()))
                            .squaredNorm();
  const auto dof = static_cast<double>(problem.numResiduals - p);
  report.residualSd = dof > 0.0 ? std::sqrt(report.sumOfSquares / dof) : 0.0;
  if (problem.jacobian ? problem.jacobian(at, jacobian) : differences(problem, at, jacobian))
    report.covariance =
        report.residualSd * report.residualSd *
        unitCovariance(
            Eigen::Map<
                const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
                jacobian.data(), static_cast<Eigen::Index>(problem.numResiduals), start.size()));
  return report;
}

}  // namespace

LeastSquaresReport solveLeastSquares(const LeastSquaresProblem& problem,
                                     const Eigen::VectorXd& start,
                                     const LeastSquaresOptions& options) {
  requireLeastSquares(problem, start, options);
  silenceCeres();
  std::vector<double> residuals(problem.numResiduals);
  if (!evaluated(problem, {start.data(), sizeOf(start)}, residuals)) {
    LeastSquaresReport report;
    report.x = start;
    report.covariance.setConstant(
        start.size(), start.size(), std::numeric_limits<double>::quiet_NaN());
    report.message = "the model is not defined at the start";
    report.sumOfSquares = report.residualSd = std::numeric_limits<double>::quiet_NaN();
    return report;
  }
  // A long first step may end where the model is flat: no minimum, though nothing descends. Then
  // shorter ones.
  LeastSquaresReport best;
  for (const double radius : {1e4, 1.0, 1e-3}) {
    const LeastSquaresReport report = descend(problem, start, options, radius);
    if (best.x.size() == 0 || !(report.sumOfSquares >= best.sumOfSquares)) best = report;
    if (best.converged && best.covariance.allFinite()) break;
  }
  return best;
}

}  // namespace palpate

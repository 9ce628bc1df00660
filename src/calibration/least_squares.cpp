#include "palpate/calibration/least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include <ceres/ceres.h>
#include <glog/logging.h>

namespace palpate {
namespace {

// Derivatives, scaled to columns of length 1, are dependent when the smallest singular value is
// below this share of the largest.
constexpr double kMinSquaresDependent = 1e-14;
// Width of a difference relative to the parameter, and the smallest size of a parameter that is
// used for it.
constexpr double kRelativeWidth = 5e-4;
constexpr double kMinSize = 1e-12;

std::size_t sizeOf(const Eigen::VectorXd& x) { return static_cast<std::size_t>(x.size()); }

// Messages of Ceres belong in the report, not in a stream of the program.
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
// width, so that large widths are possible (rounding: 1e-13 relative). Returns false where the
// model is not defined on both sides.
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
    const double width = kRelativeWidth * std::max(std::abs(x[j]), kMinSize);
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

// The model at the parameters that Ceres will use next.
class Evaluation final : public ceres::EvaluationCallback {
 public:
  Evaluation(const LeastSquaresProblem& problem, const Eigen::VectorXd& start)
      : problem_(problem),
        x_(start),
        residuals_(problem.numResiduals),
        jacobian_(problem.numResiduals * sizeOf(start)) {}
  void PrepareForEvaluation(bool jacobian, bool newPoint) override {
    const std::span<const double> at(x_.data(), sizeOf(x_));
    if (newPoint) defined_ = evaluated(problem_, at, residuals_);
    if (!jacobian || !defined_) return;
    hasJacobian_ =
        problem_.jacobian ? problem_.jacobian(at, jacobian_) : differences(problem_, at, jacobian_);
  }
  // Whether the model is defined there, and whether its derivatives are.
  bool defined() const noexcept { return defined_; }
  bool hasJacobian() const noexcept { return hasJacobian_; }
  std::span<const double> residuals() const noexcept { return residuals_; }
  std::span<const double> jacobian() const noexcept { return jacobian_; }
  Eigen::VectorXd& x() noexcept { return x_; }

 private:
  const LeastSquaresProblem& problem_;
  Eigen::VectorXd x_;
  std::vector<double> residuals_, jacobian_;
  bool defined_ = false, hasJacobian_ = false;
};

std::unique_ptr<ceres::LossFunction> lossOf(const LeastSquaresProblem& problem) {
  if (problem.loss == LeastSquaresLoss::kHuber)
    return std::make_unique<ceres::HuberLoss>(problem.lossScale);
  if (problem.loss == LeastSquaresLoss::kCauchy)
    return std::make_unique<ceres::CauchyLoss>(problem.lossScale);
  return nullptr;
}

// All residuals in one block. Ceres applies a loss to a whole block, hence the loss of each
// residual is applied here: the row is sign(r) sqrt(rho(r^2)), whose square is the loss, with its
// derivative.
class ResidualRows final : public ceres::CostFunction {
 public:
  ResidualRows(const Evaluation& evaluation,
               const ceres::LossFunction* loss,
               Eigen::Index numParameters)
      : evaluation_(evaluation), loss_(loss) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(numParameters));
    set_num_residuals(static_cast<int>(evaluation.residuals().size()));
  }
  bool Evaluate(double const* const*, double* out, double** jacobians) const override {
    const bool derivatives = jacobians != nullptr && jacobians[0] != nullptr;
    if (!evaluation_.defined() || (derivatives && !evaluation_.hasJacobian())) return false;
    const std::span<const double> residuals = evaluation_.residuals();
    const std::span<const double> jacobian = evaluation_.jacobian();
    std::copy(residuals.begin(), residuals.end(), out);
    if (derivatives) std::copy(jacobian.begin(), jacobian.end(), jacobians[0]);
    if (loss_ == nullptr) return true;
    const std::size_t p = jacobian.size() / residuals.size();
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      double rho[3];
      loss_->Evaluate(residuals[i] * residuals[i], rho);
      const double size = std::sqrt(rho[0]);
      out[i] = std::copysign(size, residuals[i]);
      if (!derivatives) continue;
      const double slope = size > 0.0 ? rho[1] * std::abs(residuals[i]) / size : std::sqrt(rho[1]);
      for (std::size_t j = i * p; j < (i + 1) * p; ++j) jacobians[0][j] *= slope;
    }
    return true;
  }

 private:
  const Evaluation& evaluation_;
  const ceres::LossFunction* loss_;
};

std::vector<double> weightsOf(const LeastSquaresProblem& problem,
                              std::span<const double> residuals) {
  std::vector<double> weights(residuals.size(), 1.0);
  const std::unique_ptr<ceres::LossFunction> loss = lossOf(problem);
  double rho[3];
  for (std::size_t i = 0; loss && i < weights.size(); ++i) {
    loss->Evaluate(residuals[i] * residuals[i], rho);
    weights[i] = rho[1];
  }
  return weights;
}

// The problem in the form of Ceres.
class CeresProblem {
 public:
  CeresProblem(const LeastSquaresProblem& problem, const Eigen::VectorXd& start)
      : evaluation_(problem, start), loss_(lossOf(problem)), ceres_(ceresOptions()) {
    double* const x = evaluation_.x().data();
    ceres_.AddResidualBlock(new ResidualRows(evaluation_, loss_.get(), start.size()), nullptr, x);
    for (Eigen::Index j = 0; j < problem.lowerBounds.size(); ++j)
      ceres_.SetParameterLowerBound(x, static_cast<int>(j), problem.lowerBounds[j]);
    for (Eigen::Index j = 0; j < problem.upperBounds.size(); ++j)
      ceres_.SetParameterUpperBound(x, static_cast<int>(j), problem.upperBounds[j]);
  }
  ceres::Problem& ceres() noexcept { return ceres_; }
  Eigen::VectorXd& x() noexcept { return evaluation_.x(); }

 private:
  ceres::Problem::Options ceresOptions() {
    ceres::Problem::Options options;
    options.evaluation_callback = &evaluation_;
    return options;
  }

  Evaluation evaluation_;
  std::unique_ptr<ceres::LossFunction> loss_;
  ceres::Problem ceres_;
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
  for (const Eigen::VectorXd* bounds : {&problem.lowerBounds, &problem.upperBounds})
    if (bounds->size() != 0 && bounds->size() != start.size())
      refuse(std::to_string(bounds->size()) + " bounds of " + std::to_string(start.size()) +
             " parameters");
  if (problem.lowerBounds.size() != 0 && (start.array() < problem.lowerBounds.array()).any())
    refuse("the start is below a bound");
  if (problem.upperBounds.size() != 0 && (start.array() > problem.upperBounds.array()).any())
    refuse("the start is above a bound");
  if (!(problem.lossScale > 0.0)) refuse("lossScale must be above 0");
  if (options.maxIterations < 1) refuse("maxIterations must be at least 1");
  if (options.firstRadii.empty() ||
      !std::all_of(
          options.firstRadii.begin(), options.firstRadii.end(), [](double r) { return r > 0.0; }))
    refuse("firstRadii must be above 0, one at least");
  if (!(options.tolerance > 0.0)) refuse("tolerance must be above 0");
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
  // A step to a place where the model is not defined is undone and shortened.
  solver.max_num_consecutive_invalid_steps = 50;
  return solver;
}

std::vector<int> parametersAtBounds(const LeastSquaresProblem& problem, const Eigen::VectorXd& x) {
  std::vector<int> at;
  for (Eigen::Index j = 0; j < x.size(); ++j)
    if ((problem.lowerBounds.size() != 0 && x[j] <= problem.lowerBounds[j]) ||
        (problem.upperBounds.size() != 0 && x[j] >= problem.upperBounds[j]))
      at.push_back(static_cast<int>(j));
  return at;
}

// One descent; the radius limits the first step.
LeastSquaresReport descend(const LeastSquaresProblem& problem,
                           const Eigen::VectorXd& start,
                           const LeastSquaresOptions& options,
                           double radius) {
  CeresProblem ceresProblem(problem, start);
  ceres::Solver::Summary summary;
  ceres::Solve(solverOptions(options, radius), &ceresProblem.ceres(), &summary);
  // Along a bound Ceres shortens every step and may end early. Parameters that have reached their
  // bound are therefore held there while the others are searched.
  const std::vector<int> held = parametersAtBounds(problem, ceresProblem.x());
  if (!held.empty() && held.size() < sizeOf(start)) {
    ceresProblem.ceres().SetManifold(
        ceresProblem.x().data(), new ceres::SubsetManifold(static_cast<int>(start.size()), held));
    ceres::Solve(solverOptions(options, radius), &ceresProblem.ceres(), &summary);
  }
  LeastSquaresReport report;
  report.x = ceresProblem.x();
  report.converged = summary.termination_type == ceres::CONVERGENCE;
  report.iterations = static_cast<int>(summary.iterations.size());
  report.message = summary.message.substr(0, summary.message.find('\n'));
  report.sumOfSquares = 2.0 * summary.final_cost;

  report.residualSd = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> residuals(problem.numResiduals);
  if (evaluated(problem, {report.x.data(), sizeOf(report.x)}, residuals)) {
    report.weights = weightsOf(problem, residuals);
    double weighted = 0.0;
    for (std::size_t i = 0; i < residuals.size(); ++i)
      weighted += report.weights[i] * residuals[i] * residuals[i];
    const auto dof = static_cast<double>(problem.numResiduals - sizeOf(start));
    report.residualSd = dof > 0.0 ? std::sqrt(weighted / dof) : 0.0;
  }
  if (options.covariance)
    report.covariance = report.residualSd * report.residualSd * unitCovariance(problem, report.x);
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
  // A long first step may end where the model is flat: no minimum, although no step descends. Then
  // try shorter first steps.
  LeastSquaresReport best;
  for (const double radius : options.firstRadii) {
    const LeastSquaresReport report = descend(problem, start, options, radius);
    if (best.x.size() == 0 || !(report.sumOfSquares >= best.sumOfSquares)) best = report;
    if (best.converged && best.covariance.allFinite()) break;
  }
  return best;
}

// ceres::Covariance compares the singular values of the Jacobian. Its columns are therefore scaled
// to length 1 first, so that units have no influence, and the covariance is scaled back.
Eigen::MatrixXd unitCovariance(const LeastSquaresProblem& problem, const Eigen::VectorXd& x) {
  silenceCeres();
  const Eigen::Index p = x.size();
  const Eigen::MatrixXd unknown =
      Eigen::MatrixXd::Constant(p, p, std::numeric_limits<double>::quiet_NaN());
  std::vector<double> residuals(problem.numResiduals);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(
      static_cast<Eigen::Index>(problem.numResiduals), p);
  const std::span<const double> at(x.data(), sizeOf(x));
  const std::span<double> cells(jacobian.data(), static_cast<std::size_t>(jacobian.size()));
  if (!evaluated(problem, at, residuals) ||
      !(problem.jacobian ? problem.jacobian(at, cells) : differences(problem, at, cells)))
    return unknown;
  const Eigen::RowVectorXd size = jacobian.colwise().norm();
  if (!size.allFinite() || !(size.minCoeff() > 0.0)) return unknown;
  jacobian.array().rowwise() /= size.array();
  const std::vector<double> weights = weightsOf(problem, residuals);
  jacobian.array().colwise() *=
      Eigen::Map<const Eigen::ArrayXd>(weights.data(), jacobian.rows()).sqrt();

  LeastSquaresProblem scaled;
  scaled.numResiduals = problem.numResiduals;
  scaled.residuals = [&](std::span<const double>, std::span<double> out) {
    std::copy(residuals.begin(), residuals.end(), out.begin());
    return true;
  };
  scaled.jacobian = [&](std::span<const double>, std::span<double> out) {
    std::copy(cells.begin(), cells.end(), out.begin());
    return true;
  };
  CeresProblem ceresProblem(scaled, x);
  const double* const block = ceresProblem.x().data();
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  options.min_reciprocal_condition_number = kMinSquaresDependent * kMinSquaresDependent;
  options.num_threads = 1;
  ceres::Covariance covariance(options);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> found(p, p);
  if (!covariance.Compute(std::vector<const double*>{block}, &ceresProblem.ceres()) ||
      !covariance.GetCovarianceBlock(block, block, found.data()))
    return unknown;
  return found.cwiseQuotient(size.transpose() * size);
}

}  // namespace palpate

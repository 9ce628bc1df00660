#include "palpate/recognition/discriminant_analysis.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <Eigen/Eigenvalues>

namespace palpate {
namespace {

// S_b over the classes that have samples.
Eigen::MatrixXd betweenScatter(const WithinScatter& within, const Eigen::VectorXd& mean) {
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(mean.size(), mean.size());
  std::size_t classes = 0;
  for (std::size_t c = 0; c < within.counts.size(); ++c) {
    if (within.counts[c] == 0) continue;
    ++classes;
    const Eigen::VectorXd away = within.means.row(static_cast<Eigen::Index>(c)).transpose() - mean;
    scatter.noalias() += static_cast<double>(within.counts[c]) * away * away.transpose();
  }
  return scatter / static_cast<double>(classes - 1);
}

std::size_t classesWithSamples(const WithinScatter& within) {
  return static_cast<std::size_t>(std::count_if(
      within.counts.begin(), within.counts.end(), [](std::size_t n) { return n > 0; }));
}

// An eigenvector's sign is arbitrary: the largest entry is made positive.
void fixSign(Eigen::Ref<Eigen::VectorXd> direction) {
  Eigen::Index at = 0;
  direction.cwiseAbs().maxCoeff(&at);
  if (direction[at] < 0.0) direction = -direction;
}

}  // namespace

void DiscriminantOptions::validate() const {
  constexpr OptionCheck check{"DiscriminantOptions"};
  check(kRidge, "ridge", ridge);
  if (shrinkage) check(kShrinkage, "shrinkage", *shrinkage);
}

WithinScatter withinScatter(const Eigen::MatrixXd& x, const std::vector<int>& y) {
  if (static_cast<std::size_t>(x.rows()) != y.size())
    throw std::invalid_argument("withinScatter: " + std::to_string(x.rows()) + " samples, " +
                                std::to_string(y.size()) + " labels");
  if (y.empty()) throw std::invalid_argument("withinScatter: no sample");
  const auto [least, most] = std::minmax_element(y.begin(), y.end());
  if (*least < 0) throw std::invalid_argument("withinScatter: a label below 0");
  WithinScatter within;
  within.counts.assign(static_cast<std::size_t>(*most) + 1, 0);
  within.means = Eigen::MatrixXd::Zero(*most + 1, x.cols());
  for (std::size_t i = 0; i < y.size(); ++i) {
    ++within.counts[static_cast<std::size_t>(y[i])];
    within.means.row(y[i]) += x.row(static_cast<Eigen::Index>(i));
  }
  for (std::size_t c = 0; c < within.counts.size(); ++c)
    if (within.counts[c] > 0)
      within.means.row(static_cast<Eigen::Index>(c)) /= static_cast<double>(within.counts[c]);
  within.residuals.resize(x.rows(), x.cols());
  for (std::size_t i = 0; i < y.size(); ++i)
    within.residuals.row(static_cast<Eigen::Index>(i)) =
        x.row(static_cast<Eigen::Index>(i)) - within.means.row(y[i]);
  const std::size_t classes = classesWithSamples(within);
  if (y.size() <= classes)
    throw std::invalid_argument("withinScatter: " + std::to_string(y.size()) + " samples of " +
                                std::to_string(classes) + " classes: none has two");
  within.degreesOfFreedom = y.size() - classes;
  within.covariance = within.residuals.transpose() * within.residuals /
                      static_cast<double>(within.degreesOfFreedom);
  return within;
}

double ledoitWolfShrinkage(const Eigen::MatrixXd& residuals) {
  const auto n = static_cast<double>(residuals.rows());
  const auto d = static_cast<double>(residuals.cols());
  if (residuals.rows() == 0 || residuals.cols() == 0) return 1.0;
  const Eigen::MatrixXd s = residuals.transpose() * residuals / n;
  const double mu = s.trace() / d;
  const double delta = (s.squaredNorm() - d * mu * mu) / d;  // |S - mu I|^2 / d
  if (!(delta > 0.0)) return 1.0;
  // |x x' - S|^2 summed over the samples = sum |x|^4 - n |S|^2
  const double spread =
      residuals.rowwise().squaredNorm().array().square().sum() - n * s.squaredNorm();
  return std::clamp(spread / (d * n * n) / delta, 0.0, 1.0);
}

Eigen::MatrixXd regularised(const Eigen::MatrixXd& covariance, double share, double ridge) {
  const double level = covariance.trace() / static_cast<double>(covariance.rows());
  Eigen::MatrixXd sum = (1.0 - share) * covariance;
  sum.diagonal().array() += level > 0.0 ? (share + ridge) * level : ridge;
  return sum;
}

DiscriminantAnalysis DiscriminantAnalysis::of(const Eigen::MatrixXd& x,
                                              const std::vector<int>& y,
                                              const DiscriminantOptions& options) {
  options.validate();
  const WithinScatter within = withinScatter(x, y);
  const std::size_t classes = classesWithSamples(within);
  if (classes < 2) throw std::invalid_argument("DiscriminantAnalysis: fewer than two classes");
  DiscriminantAnalysis fitted;
  fitted.mean = x.colwise().mean().transpose();
  fitted.shrinkage = options.shrinkage ? *options.shrinkage : ledoitWolfShrinkage(within.residuals);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      betweenScatter(within, fitted.mean),
      regularised(within.covariance, fitted.shrinkage, options.ridge));
  if (solver.info() != Eigen::Success)
    throw std::invalid_argument(
        "DiscriminantAnalysis: the scatter has values that are not numbers");
  const std::size_t there = std::min(static_cast<std::size_t>(x.cols()), classes - 1);
  const auto count = static_cast<Eigen::Index>(
      options.components == 0 ? there : std::min(options.components, there));
  // The eigenvalues are in ascending order.
  fitted.directions = solver.eigenvectors().rightCols(count).rowwise().reverse();
  fitted.separation = solver.eigenvalues().tail(count).reverse().cwiseMax(0.0);
  for (Eigen::Index k = 0; k < count; ++k) fixSign(fitted.directions.col(k));
  return fitted;
}

Eigen::MatrixXd DiscriminantAnalysis::apply(const Eigen::MatrixXd& x) const {
  if (x.cols() != mean.size())
    throw std::invalid_argument("DiscriminantAnalysis: " + std::to_string(x.cols()) +
                                " features, fitted to " + std::to_string(mean.size()));
  return (x.rowwise() - mean.transpose()) * directions;
}

Eigen::VectorXd DiscriminantAnalysis::featureWeights() const {
  Eigen::VectorXd weights = (directions.cwiseAbs2() * separation).cwiseSqrt();
  const double sum = weights.sum();
  if (sum > 0.0) weights /= sum;
  return weights;
}

}  // namespace palpate

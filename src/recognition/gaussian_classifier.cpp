#include "palpate/recognition/gaussian_classifier.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <Eigen/Cholesky>

#include "palpate/recognition/discriminant_analysis.h"

namespace palpate {
namespace {

void requireShare(double value, double most, const char* name) {
  if (!(value >= 0.0) || !(value <= most))
    throw std::invalid_argument(std::string("ClassGaussianOptions: ") + name + " is out of range");
}

// S_c of every class with at least two samples; empty for the others.
std::vector<Eigen::MatrixXd> classCovariances(const WithinScatter& within,
                                              const std::vector<int>& y,
                                              std::size_t numClasses) {
  std::vector<Eigen::MatrixXd> sums(numClasses);
  for (std::size_t i = 0; i < y.size(); ++i) {
    const auto c = static_cast<std::size_t>(y[i]);
    if (within.counts[c] < 2) continue;
    const Eigen::VectorXd residual = within.residuals.row(static_cast<Eigen::Index>(i)).transpose();
    if (sums[c].size() == 0) sums[c] = Eigen::MatrixXd::Zero(residual.size(), residual.size());
    sums[c].noalias() +=
        residual * residual.transpose() / static_cast<double>(within.counts[c] - 1);
  }
  return sums;
}

}  // namespace

void ClassGaussianOptions::validate() const {
  requireShare(pooledFraction, 1.0, "pooledFraction");
  requireShare(correlationScale, 1.0, "correlationScale");
  requireShare(extraVariance, 1e6, "extraVariance");
  if (!(ridge >= 1e-9) || !(ridge <= 1.0))
    throw std::invalid_argument("ClassGaussianOptions: ridge must be 1e-9 .. 1");
}

GaussianClassifier GaussianClassifier::of(const Eigen::MatrixXd& x,
                                          const std::vector<int>& y,
                                          std::size_t numClasses,
                                          const ClassGaussianOptions& options) {
  options.validate();
  for (const int label : y)
    if (label < 0 || static_cast<std::size_t>(label) >= numClasses)
      throw std::invalid_argument("GaussianClassifier: label " + std::to_string(label) + " of " +
                                  std::to_string(numClasses) + " classes");
  const WithinScatter within = withinScatter(x, y);
  const Eigen::MatrixXd& pooled = within.covariance;
  const std::vector<Eigen::MatrixXd> own = classCovariances(within, y, numClasses);
  const double level = pooled.trace() / static_cast<double>(pooled.rows());
  GaussianClassifier fitted;
  fitted.classes.resize(numClasses);
  for (std::size_t c = 0; c < within.counts.size(); ++c) {
    if (within.counts[c] == 0) continue;
    Class& one = fitted.classes[c];
    one.present = true;
    one.mean = within.means.row(static_cast<Eigen::Index>(c)).transpose();
    Eigen::MatrixXd covariance = pooled;
    if (own[c].size() > 0)
      covariance = (1.0 - options.pooledFraction) * own[c] + options.pooledFraction * pooled;
    const Eigen::VectorXd diagonal = covariance.diagonal();
    covariance *= options.correlationScale;
    covariance.diagonal() = diagonal + options.extraVariance * pooled.diagonal();
    covariance.diagonal().array() += options.ridge * (level > 0.0 ? level : 1.0);
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
    if (factor.info() != Eigen::Success)
      throw std::invalid_argument("GaussianClassifier: the covariance of class " +
                                  std::to_string(c) + " can't be inverted: a larger ridge");
    const auto size = covariance.rows();
    one.whitening = factor.matrixL().solve(Eigen::MatrixXd::Identity(size, size));
    one.logDeterminant = 2.0 * Eigen::MatrixXd(factor.matrixL()).diagonal().array().log().sum();
  }
  return fitted;
}

Eigen::MatrixXd GaussianClassifier::logDensity(const Eigen::MatrixXd& x) const {
  Eigen::MatrixXd density = Eigen::MatrixXd::Constant(x.rows(),
                                                      static_cast<Eigen::Index>(classes.size()),
                                                      -std::numeric_limits<double>::infinity());
  for (std::size_t c = 0; c < classes.size(); ++c) {
    const Class& one = classes[c];
    if (!one.present) continue;
    const Eigen::MatrixXd white = (x.rowwise() - one.mean.transpose()) * one.whitening.transpose();
    density.col(static_cast<Eigen::Index>(c)) =
        -0.5 * (white.rowwise().squaredNorm().array() + one.logDeterminant);
  }
  return density;
}

Eigen::VectorXd GaussianClassifier::nearestSquaredDistance(const Eigen::MatrixXd& x) const {
  Eigen::VectorXd nearest =
      Eigen::VectorXd::Constant(x.rows(), std::numeric_limits<double>::infinity());
  for (const Class& one : classes) {
    if (!one.present) continue;
    const Eigen::MatrixXd white = (x.rowwise() - one.mean.transpose()) * one.whitening.transpose();
    nearest = nearest.cwiseMin(white.rowwise().squaredNorm());
  }
  return nearest;
}

}  // namespace palpate

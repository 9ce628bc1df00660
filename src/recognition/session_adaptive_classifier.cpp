#include "palpate/recognition/session_adaptive_classifier.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <Eigen/Cholesky>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/recognition/plateau_features.h"

namespace palpate {
namespace {

// Smallest variance of a feature, as a fraction of its variance over all samples. It applies to
// features that are constant within a class.
constexpr double kMinVariancePart = 1e-6;
constexpr double kMinVariance = 1e-12;

// std::lgamma() writes the sign to a global variable, which is a data race when models are fitted
// on several threads.
double logGamma(double x) {
  int sign = 0;
  return ::lgamma_r(x, &sign);
}

void requireSamples(const Eigen::MatrixXd& x,
                    const std::vector<int>& y,
                    std::size_t classes,
                    std::size_t features) {
  if (static_cast<std::size_t>(x.rows()) != y.size() ||
      static_cast<std::size_t>(x.cols()) != features)
    throw std::invalid_argument("SessionAdaptiveClassifier: " + std::to_string(x.rows()) + " x " +
                                std::to_string(x.cols()) + " values for " +
                                std::to_string(y.size()) + " classes and " +
                                std::to_string(features) + " features");
  for (const int of : y)
    if (of < 0 || static_cast<std::size_t>(of) >= classes)
      throw std::invalid_argument("SessionAdaptiveClassifier: there is no class " +
                                  std::to_string(of));
}

// Means and covariance matrices of the classes.
struct Scatters {
  std::vector<Eigen::VectorXd> means;
  // Covariance matrix per class; empty for classes with fewer than two samples.
  std::vector<Eigen::MatrixXd> own;
  std::vector<double> counts;
  Eigen::MatrixXd pooled;
};

Scatters scattersOf(const Eigen::MatrixXd& x, const std::vector<int>& y, std::size_t classes) {
  const Eigen::Index d = x.cols();
  Scatters out;
  out.means.assign(classes, Eigen::VectorXd::Zero(d));
  out.counts.assign(classes, 0.0);
  std::vector<Eigen::MatrixXd> sums(classes, Eigen::MatrixXd::Zero(d, d));
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const auto c = static_cast<std::size_t>(y[static_cast<std::size_t>(i)]);
    out.means[c] += x.row(i).transpose();
    out.counts[c] += 1.0;
  }
  for (std::size_t c = 0; c < classes; ++c)
    if (out.counts[c] > 0.0) out.means[c] /= out.counts[c];
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const auto c = static_cast<std::size_t>(y[static_cast<std::size_t>(i)]);
    const Eigen::VectorXd away = x.row(i).transpose() - out.means[c];
    sums[c] += away * away.transpose();
  }
  out.pooled = Eigen::MatrixXd::Zero(d, d);
  double freedom = 0.0;
  for (std::size_t c = 0; c < classes; ++c) {
    out.pooled += sums[c];
    freedom += std::max(0.0, out.counts[c] - 1.0);
    out.own.push_back(out.counts[c] > 1.0 ? Eigen::MatrixXd(sums[c] / (out.counts[c] - 1.0))
                                          : Eigen::MatrixXd());
  }
  if (freedom > 0.0) out.pooled /= freedom;
  return out;
}

Eigen::VectorXd sessionVariance(const Eigen::MatrixXd& pooled,
                                const std::vector<std::string>& features,
                                const SessionAdaptiveOptions& options) {
  Eigen::VectorXd variance = options.sessionVarianceFraction * pooled.diagonal();
  for (std::size_t f = 0; f < features.size(); ++f)
    for (const auto& [name, sd] : options.sessionSd)
      if (name == features[f]) variance[static_cast<Eigen::Index>(f)] = sd * sd;
  return variance;
}

// Scatter of the class means about their mean.
Eigen::MatrixXd between(const std::vector<Eigen::VectorXd>& means, const Eigen::VectorXd& middle) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(middle.size(), middle.size());
  for (const Eigen::VectorXd& mean : means) sum += (mean - middle) * (mean - middle).transpose();
  return sum / std::max(1.0, static_cast<double>(means.size()) - 1.0);
}

}  // namespace

void SessionAdaptiveOptions::validate() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("SessionAdaptiveOptions: ") + what);
  };
  require(classCovarianceFraction >= 0.0 && classCovarianceFraction <= 1.0,
          "classCovarianceFraction must be 0..1");
  require(correlationScale >= 0.0 && correlationScale <= 1.0, "correlationScale must be 0..1");
  require(degreesOfFreedom > 2.0 && std::isfinite(degreesOfFreedom),
          "degreesOfFreedom must be above 2");
  require(sessionVarianceFraction >= 0.0 && std::isfinite(sessionVarianceFraction),
          "sessionVarianceFraction must be >= 0");
  for (const auto& [name, sd] : sessionSd)
    require(sd >= 0.0 && std::isfinite(sd), "a standard deviation must be >= 0");
  require(fewShotScatterScale > 0.0 && std::isfinite(fewShotScatterScale),
          "fewShotScatterScale must be > 0");
  require(seenInSessionLogPrior >= 0.0 && std::isfinite(seenInSessionLogPrior),
          "seenInSessionLogPrior must be >= 0");
}

SessionAdaptiveClassifier SessionAdaptiveClassifier::learn(const Eigen::MatrixXd& x,
                                                           const std::vector<int>& y,
                                                           std::vector<std::string> classes,
                                                           std::vector<std::string> features,
                                                           const SessionAdaptiveOptions& options) {
  options.validate();
  requireSamples(x, y, classes.size(), features.size());
  if (classes.size() < 2) throw Error("a model needs two classes or more");
  if (!x.allFinite()) throw Error("features that are not numbers");
  const Scatters scatters = scattersOf(x, y, classes.size());
  for (std::size_t c = 0; c < classes.size(); ++c)
    if (scatters.counts[c] == 0.0)
      throw Error("class '" + shortened(classes[c]) + "' has no sample");
  if (*std::max_element(scatters.counts.begin(), scatters.counts.end()) < 2.0)
    throw Error("every class has one sample only: record at least two grasps of an object");

  SessionAdaptiveParameters data;
  data.degreesOfFreedom = options.degreesOfFreedom;
  data.fewShotScatterScale = options.fewShotScatterScale;
  data.seenInSessionLogPrior = options.seenInSessionLogPrior;
  const auto size = std::find(features.begin(), features.end(), options.sizeFeature);
  if (size != features.end()) data.sizeColumn = static_cast<std::size_t>(size - features.begin());

  // Features that are constant in training get a small variance so that other values stay possible.
  data.pooled = scatters.pooled;
  std::vector<std::string> constant;
  for (Eigen::Index f = 0; f < x.cols(); ++f) {
    const double all = (x.col(f).array() - x.col(f).mean()).square().mean();
    const double least = std::max(kMinVariance, kMinVariancePart * all);
    if (all == 0.0) constant.push_back(features[static_cast<std::size_t>(f)]);
    data.pooled(f, f) = std::max(data.pooled(f, f), least);
  }
  const Eigen::VectorXd sessionVariances = sessionVariance(data.pooled, features, options);
  for (std::size_t c = 0; c < classes.size(); ++c) {
    Eigen::MatrixXd scatter = data.pooled;
    if (scatters.own[c].size() > 0)
      scatter = options.classCovarianceFraction * scatters.own[c] +
                (1.0 - options.classCovarianceFraction) * data.pooled;
    const Eigen::VectorXd variances = scatter.diagonal();
    scatter *= options.correlationScale;
    scatter.diagonal() =
        variances.cwiseMax(kMinVariancePart * data.pooled.diagonal()) + sessionVariances;
    data.classComponents.push_back({scatters.means[c], scatter});
  }
  data.background.mean = Eigen::VectorXd::Zero(x.cols());
  for (const Eigen::VectorXd& mean : scatters.means) data.background.mean += mean;
  data.background.mean /= static_cast<double>(classes.size());
  data.background.scatter = between(scatters.means, data.background.mean) + data.pooled;
  data.background.scatter.diagonal() += sessionVariances;
  data.classes = std::move(classes);
  data.features = std::move(features);
  SessionAdaptiveClassifier model(std::move(data));
  model.constant_ = std::move(constant);
  return model;
}

SessionAdaptiveClassifier::SessionAdaptiveClassifier(SessionAdaptiveParameters data)
    : data_(std::move(data)) {
  if (data_.classes.size() < 2 || data_.classComponents.size() != data_.classes.size())
    throw Error("a model of " + std::to_string(data_.classes.size()) + " classes with " +
                std::to_string(data_.classComponents.size()) + " descriptions");
  const auto d = static_cast<Eigen::Index>(data_.features.size());
  if (d == 0) throw Error("a model without features");
  if (data_.sizeColumn && *data_.sizeColumn >= data_.features.size())
    throw Error("a model whose size doesn't match its features");
  if (!(data_.degreesOfFreedom > 2.0 && std::isfinite(data_.degreesOfFreedom)))
    throw Error("a model with degrees of freedom not above 2");
  if (!(data_.fewShotScatterScale > 0.0 && std::isfinite(data_.fewShotScatterScale)) ||
      !(data_.seenInSessionLogPrior >= 0.0 && std::isfinite(data_.seenInSessionLogPrior)))
    throw Error("a model with a weight that is not a number");
  if (data_.pooled.rows() != d || data_.pooled.cols() != d || !data_.pooled.allFinite())
    throw Error("a model with a scatter of a different size than its features");
  for (std::size_t c = 0; c < data_.classComponents.size(); ++c)
    classComponents_.push_back(
        prepare(data_.classComponents[c], "class '" + shortened(data_.classes[c]) + "'"));
  background_ = prepare(data_.background, "the background");
  for (const SessionComponent& component : data_.today) {
    if (component.classIndex >= data_.classes.size())
      throw Error("a model that saw a class today that it does not know");
    sessionComponents_.push_back(
        prepare(component.distribution,
                "class '" + shortened(data_.classes[component.classIndex]) + "' of today"));
  }
}

SessionAdaptiveClassifier::Prepared SessionAdaptiveClassifier::prepare(
    const StudentTComponent& distribution, const std::string& what) const {
  const auto d = static_cast<Eigen::Index>(data_.features.size());
  if (distribution.mean.size() != d || distribution.scatter.rows() != d ||
      distribution.scatter.cols() != d)
    throw Error("a model with a description of a different size than its features: " + what);
  if (!distribution.mean.allFinite() || !distribution.scatter.allFinite())
    throw Error("a model with values that are not numbers: " + what);
  // The features differ by orders of magnitude; scaling makes the decomposition well conditioned.
  if (!(distribution.scatter.diagonal().minCoeff() > 0.0))
    throw Error("a model with a variance that isn't positive: " + what);
  const Eigen::VectorXd scale = distribution.scatter.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd correlation =
      scale.asDiagonal() * distribution.scatter * scale.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> root(correlation);
  if (root.info() != Eigen::Success)
    throw Error("a model with a scatter that isn't positive definite: " + what);
  Prepared out;
  out.mean = distribution.mean;
  out.whitening = root.matrixL().solve(Eigen::MatrixXd(scale.asDiagonal()));
  const double nu = data_.degreesOfFreedom, n = static_cast<double>(d);
  const double lnDeterminant =
      2.0 * (root.matrixLLT().diagonal().array().log().sum() - scale.array().log().sum());
  out.constant = logGamma((nu + n) / 2.0) - logGamma(nu / 2.0) -
                 0.5 * n * std::log(nu * std::numbers::pi) - 0.5 * lnDeterminant;
  return out;
}

double SessionAdaptiveClassifier::logDensity(const Prepared& distribution,
                                             const Eigen::VectorXd& x) const {
  const double nu = data_.degreesOfFreedom;
  const double squared =
      (distribution.whitening.triangularView<Eigen::Lower>() * (x - distribution.mean))
          .squaredNorm();
  return distribution.constant -
         0.5 * (nu + static_cast<double>(x.size())) * std::log1p(squared / nu);
}

Eigen::VectorXd SessionAdaptiveClassifier::withoutOffset(const Eigen::VectorXd& x,
                                                         double offsetMm) const {
  if (static_cast<std::size_t>(x.size()) != data_.features.size())
    throw std::invalid_argument("SessionAdaptiveClassifier: " + std::to_string(x.size()) +
                                " values for " + std::to_string(data_.features.size()) +
                                " features");
  if (!x.allFinite() || !std::isfinite(offsetMm))
    throw std::invalid_argument("SessionAdaptiveClassifier: a value that is not a number");
  return moved(x, offsetMm);
}

Eigen::VectorXd SessionAdaptiveClassifier::moved(const Eigen::VectorXd& x, double offsetMm) const {
  Eigen::VectorXd out = x;
  if (data_.sizeColumn && offsetMm != 0.0) {
    double& size = out[static_cast<Eigen::Index>(*data_.sizeColumn)];
    size = sizeZ(distanceOfSizeZ(size) - offsetMm);
  }
  return out;
}

Eigen::VectorXd SessionAdaptiveClassifier::logLikelihoods(const Eigen::VectorXd& x,
                                                          double offsetMm) const {
  const Eigen::VectorXd at = withoutOffset(x, offsetMm);
  Eigen::VectorXd out(static_cast<Eigen::Index>(classComponents_.size()));
  for (std::size_t c = 0; c < classComponents_.size(); ++c)
    out[static_cast<Eigen::Index>(c)] = logDensity(classComponents_[c], at);
  for (std::size_t i = 0; i < sessionComponents_.size(); ++i) {
    double& best = out[static_cast<Eigen::Index>(data_.today[i].classIndex)];
    best = std::max(best, logDensity(sessionComponents_[i], at));
  }
  return out;
}

Eigen::VectorXd SessionAdaptiveClassifier::logPrior() const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(classComponents_.size()));
  for (const SessionComponent& component : data_.today)
    out[static_cast<Eigen::Index>(component.classIndex)] = data_.seenInSessionLogPrior;
  return out;
}

double SessionAdaptiveClassifier::logBackground(const Eigen::VectorXd& x, double offsetMm) const {
  return logDensity(background_, withoutOffset(x, offsetMm));
}

void SessionAdaptiveClassifier::addSessionComponents(const Eigen::MatrixXd& x,
                                                     const std::vector<int>& y,
                                                     double offsetMm) {
  requireSamples(x, y, data_.classes.size(), data_.features.size());
  if (!x.allFinite()) throw Error("features that are not numbers");
  std::vector<std::pair<Eigen::VectorXd, double>> sums(data_.classes.size(),
                                                       {Eigen::VectorXd::Zero(x.cols()), 0.0});
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    auto& [sum, count] = sums[static_cast<std::size_t>(y[static_cast<std::size_t>(i)])];
    sum += withoutOffset(x.row(i).transpose(), offsetMm);
    count += 1.0;
  }
  for (std::size_t c = 0; c < sums.size(); ++c) {
    const auto& [sum, count] = sums[c];
    if (count == 0.0) continue;
    SessionComponent component;
    component.classIndex = c;
    component.count = static_cast<std::size_t>(count);
    component.distribution = {sum / count,
                              data_.fewShotScatterScale * (1.0 + 1.0 / count) * data_.pooled};
    const Prepared prepared =
        prepare(component.distribution, "class '" + shortened(data_.classes[c]) + "' of today");
    const auto same = std::find_if(data_.today.begin(), data_.today.end(), [&](const auto& known) {
      return known.classIndex == c;
    });
    if (same != data_.today.end()) {
      sessionComponents_[static_cast<std::size_t>(same - data_.today.begin())] = prepared;
      *same = std::move(component);
    } else {
      sessionComponents_.push_back(prepared);
      data_.today.push_back(std::move(component));
    }
  }
}

}  // namespace palpate

#include "palpate/recognition/probability_calibration.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace palpate {
namespace {

// -ln likelihood of sigmoid(a f + b) for targets t, without overflow.
double sigmoidLoss(const std::vector<double>& f,
                   const std::vector<double>& target,
                   double a,
                   double b) {
  double loss = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    const double z = a * f[i] + b;
    loss += z >= 0.0 ? target[i] * z + std::log1p(std::exp(-z))
                     : (target[i] - 1.0) * z + std::log1p(std::exp(z));
  }
  return loss;
}

double exponentLoss(const Eigen::MatrixXd& scores, const std::vector<int>& y, double exponent) {
  double loss = 0.0;
  for (Eigen::Index i = 0; i < scores.rows(); ++i) {
    const double own = scores(i, y[static_cast<std::size_t>(i)]);
    if (!std::isfinite(own)) continue;
    const double top = scores.row(i).maxCoeff();
    loss +=
        std::log(((scores.row(i).array() - top) * exponent).exp().sum()) - exponent * (own - top);
  }
  return loss;
}

}  // namespace

double Sigmoid::at(double decision) const noexcept {
  const double z = a * decision + b;
  return z >= 0.0 ? std::exp(-z) / (1.0 + std::exp(-z)) : 1.0 / (1.0 + std::exp(z));
}

Sigmoid fitSigmoid(const std::vector<double>& decisions, const std::vector<bool>& first) {
  if (decisions.empty() || decisions.size() != first.size())
    throw std::invalid_argument("fitSigmoid: as many labels as decisions, one at least");
  constexpr int kMaxSteps = 100;
  constexpr double kRidge = 1e-12, kMinStep = 1e-10, kFlat = 1e-5;
  const auto positive = static_cast<double>(std::count(first.begin(), first.end(), true));
  const double negative = static_cast<double>(first.size()) - positive;
  const double high = (positive + 1.0) / (positive + 2.0), low = 1.0 / (negative + 2.0);
  std::vector<double> target(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) target[i] = first[i] ? high : low;
  double a = 0.0, b = std::log((negative + 1.0) / (positive + 1.0));
  double loss = sigmoidLoss(decisions, target, a, b);
  for (int step = 0; step < kMaxSteps; ++step) {
    double h11 = kRidge, h22 = kRidge, h21 = 0.0, g1 = 0.0, g2 = 0.0;
    for (std::size_t i = 0; i < decisions.size(); ++i) {
      const double p = Sigmoid{a, b}.at(decisions[i]), d2 = p * (1.0 - p), d1 = target[i] - p;
      h11 += decisions[i] * decisions[i] * d2;
      h22 += d2;
      h21 += decisions[i] * d2;
      g1 += decisions[i] * d1;
      g2 += d1;
    }
    if (std::abs(g1) < kFlat && std::abs(g2) < kFlat) break;
    const double determinant = h11 * h22 - h21 * h21;
    const double da = -(h22 * g1 - h21 * g2) / determinant;
    const double db = -(-h21 * g1 + h11 * g2) / determinant;
    const double slope = g1 * da + g2 * db;
    double length = 1.0;
    for (; length >= kMinStep; length /= 2.0) {
      const double trial = sigmoidLoss(decisions, target, a + length * da, b + length * db);
      if (!(trial < loss + 1e-4 * length * slope)) continue;
      a += length * da;
      b += length * db;
      loss = trial;
      break;
    }
    if (length < kMinStep) break;
  }
  return {a, b};
}

Eigen::VectorXd coupleProbabilities(const Eigen::MatrixXd& pairwise) {
  const Eigen::Index k = pairwise.rows();
  if (k == 0 || pairwise.cols() != k)
    throw std::invalid_argument("coupleProbabilities: the matrix must be square and not empty");
  constexpr double kMinimum = 1e-7;
  Eigen::MatrixXd r = pairwise.cwiseMax(kMinimum).cwiseMin(1.0 - kMinimum);
  Eigen::MatrixXd q(k, k);
  for (Eigen::Index i = 0; i < k; ++i) {
    q(i, i) = 0.0;
    for (Eigen::Index j = 0; j < k; ++j) {
      if (i == j) continue;
      q(i, i) += r(j, i) * r(j, i);
      q(i, j) = -r(j, i) * r(i, j);
    }
  }
  Eigen::VectorXd p = Eigen::VectorXd::Constant(k, 1.0 / static_cast<double>(k));
  const double tolerance = 0.005 / static_cast<double>(k);
  const auto most = std::max<Eigen::Index>(100, k);
  for (Eigen::Index round = 0; round < most; ++round) {
    Eigen::VectorXd qp = q * p;
    double pqp = p.dot(qp);
    if ((qp.array() - pqp).abs().maxCoeff() < tolerance) break;
    for (Eigen::Index t = 0; t < k; ++t) {
      const double change = (pqp - qp[t]) / q(t, t);
      p[t] += change;
      pqp = (pqp + change * (change * q(t, t) + 2.0 * qp[t])) / ((1.0 + change) * (1.0 + change));
      qp = (qp + change * q.col(t)) / (1.0 + change);
      p /= 1.0 + change;
    }
  }
  return p / p.sum();
}

Eigen::MatrixXd softmaxRows(const Eigen::MatrixXd& scores, double exponent) {
  Eigen::MatrixXd p(scores.rows(), scores.cols());
  for (Eigen::Index i = 0; i < scores.rows(); ++i) {
    p.row(i) = ((scores.row(i).array() - scores.row(i).maxCoeff()) * exponent).exp();
    p.row(i) /= p.row(i).sum();
  }
  return p;
}

double fitExponent(const Eigen::MatrixXd& scores, const std::vector<int>& y) {
  if (static_cast<std::size_t>(scores.rows()) != y.size())
    throw std::invalid_argument("fitExponent: as many labels as rows");
  bool any = false;
  for (Eigen::Index i = 0; i < scores.rows(); ++i)
    any = any || std::isfinite(scores(i, y[static_cast<std::size_t>(i)]));
  if (!any) return 1.0;
  // The loss is convex in the exponent: golden section over its logarithm.
  const double ratio = (std::sqrt(5.0) - 1.0) / 2.0;
  double low = std::log(0.01), high = std::log(50.0);
  double x1 = high - ratio * (high - low), x2 = low + ratio * (high - low);
  double f1 = exponentLoss(scores, y, std::exp(x1)), f2 = exponentLoss(scores, y, std::exp(x2));
  while (high - low > 1e-3) {
    if (f1 < f2) {
      high = x2;
      x2 = x1;
      f2 = f1;
      x1 = high - ratio * (high - low);
      f1 = exponentLoss(scores, y, std::exp(x1));
    } else {
      low = x1;
      x1 = x2;
      f1 = f2;
      x2 = low + ratio * (high - low);
      f2 = exponentLoss(scores, y, std::exp(x2));
    }
  }
  return std::exp((low + high) / 2.0);
}

}  // namespace palpate

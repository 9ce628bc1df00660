#include "calibration/step_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "calibration/overdamped_shape.h"

namespace palpate {
namespace {

constexpr double kStepSearchSettled = 38.0;  // e^-38 is below the rounding of 1
// a step beyond a factor of e says nothing about the place it leads to
constexpr double kNear = 1.0;
// A search that comes so near to a known minimum, and goes on towards it, finds nothing new.
constexpr double kSame = 0.02;
// T1/T2 - 1 below which the search by times gives up: towards d = 1 its two logarithms run along a
// bent valley.
constexpr double kNearlyCritical = -0.5;

// Linear part of the fit: K and m from the moments; false where they can't be told apart.
struct Linear {
  double gain = 0.0, drift = 0.0, sumOfSquares = std::numeric_limits<double>::infinity();
};

Linear solveLinear(const StepSamples::Moments& s) {
  Linear out;
  const double det = s.pp * s.tt - s.pt * s.pt;
  if (!(det > 1e-13 * s.pp * s.tt)) return out;
  out.gain = (s.tt * s.py - s.pt * s.ty) / det;
  out.drift = (s.pp * s.ty - s.pt * s.py) / det;
  out.sumOfSquares = std::max(s.yy - out.gain * s.py - out.drift * s.ty, 0.0);
  return out;
}

// Kaufman's approximation of variable projection: the derivatives' parts that K and m can't follow.
struct Normal {
  Eigen::Matrix2d matrix;
  Eigen::Vector2d gradient;
};

Normal normalEquations(const StepSamples::Moments& s, const Linear& linear) {
  const double det = s.pp * s.tt - s.pt * s.pt;
  // Inner product of the projected derivatives: <a,b> - <a,P b> with P on span(phi, t).
  const auto inner = [&](double ab, double ap, double at, double bp, double bt) {
    return ab - (ap * (s.tt * bp - s.pt * bt) + at * (s.pp * bt - s.pt * bp)) / det;
  };
  const double k = linear.gain;
  Normal normal;
  normal.matrix(0, 0) = k * k * std::max(inner(s.aa, s.ap, s.at, s.ap, s.at), 0.0);
  normal.matrix(1, 1) = k * k * std::max(inner(s.bb, s.bp, s.bt, s.bp, s.bt), 0.0);
  normal.matrix(0, 1) = normal.matrix(1, 0) = k * k * inner(s.ab, s.ap, s.at, s.bp, s.bt);
  normal.gradient[0] = k * (s.ay - k * s.ap - linear.drift * s.at);
  normal.gradient[1] = k * (s.by - k * s.bp - linear.drift * s.bt);
  return normal;
}

// The step of damping `lambda`; a parameter at its bound that wants out stays.
Eigen::Vector2d dampedStep(const Normal& normal,
                           double lambda,
                           const Eigen::Vector2d& at,
                           const StepSearchBounds& bounds) {
  Eigen::Matrix2d matrix = normal.matrix;
  Eigen::Vector2d gradient = normal.gradient;
  for (int i = 0; i < 2; ++i) {
    const bool out = (at[i] <= bounds.least[i] && gradient[i] < 0.0) ||
                     (at[i] >= bounds.most[i] && gradient[i] > 0.0);
    if (out) {
      matrix.row(i).setZero();
      matrix.col(i).setZero();
      gradient[i] = 0.0;
    }
    // Logarithms: a unit step is a factor of e, so that damping may be absolute, too.
    const double scale = std::max(normal.matrix(i, i), 1e-12 * normal.matrix.trace());
    matrix(i, i) += lambda * scale + std::numeric_limits<double>::min();
  }
  Eigen::Vector2d step = matrix.inverse() * gradient;
  if (!step.allFinite()) step.setZero();
  for (int i = 0; i < 2; ++i) step[i] = std::clamp(step[i], -2.0, 2.0);
  return step;
}

// What the products of the derivatives leave out of the second derivatives, learnt from how the
// gradient changed (the structured secant update of NL2SOL): with large residuals the search would
// only creep without it.
class SecantPart {
 public:
  // `gradient` is minus the derivative of half the sum of squares; `products` at the new place.
  void learn(const Eigen::Vector2d& step,
             const Eigen::Vector2d& gradientBefore,
             const Normal& now) {
    const Eigen::Vector2d change = gradientBefore - now.gradient;
    const double curvature = change.dot(step);
    if (!(curvature > 1e-12 * change.norm() * step.norm())) {
      part_.setZero();
      return;
    }
    const Eigen::Vector2d wanted = change - now.matrix * step;
    const double has = std::abs(step.dot(part_ * step));
    if (has > 0.0) part_ *= std::min(1.0, std::abs(step.dot(wanted)) / has);
    const Eigen::Vector2d missing = wanted - part_ * step;
    part_ += (missing * change.transpose() + change * missing.transpose()) / curvature -
             missing.dot(step) / (curvature * curvature) * change * change.transpose();
    if (!part_.allFinite()) part_.setZero();
  }
  void forget() { part_.setZero(); }
  // The whole second derivative where it has a minimum, else the products alone.
  Normal completed(const Normal& normal) const {
    Normal whole = normal;
    whole.matrix += part_;
    const double least = kLeastShare * normal.matrix.determinant();
    return whole.matrix(0, 0) > 0.0 && whole.matrix(1, 1) > 0.0 &&
                   whole.matrix.determinant() > least
               ? whole
               : normal;
  }

 private:
  static constexpr double kLeastShare = 0.05;
  Eigen::Matrix2d part_ = Eigen::Matrix2d::Zero();
};

// T1 + T2 and T1 T2, which change smoothly through d = 1.
Eigen::Vector2d sumAndProduct(const Eigen::Vector2d& at, StepCoordinates by) {
  const double first = std::exp(at[0]);
  if (by == StepCoordinates::kDamping) return {2.0 * at[1] * first, first * first};
  const double t1 = first * (1.0 + std::exp(at[1]));
  return {t1 + first, t1 * first};
}

bool nearKnown(const Eigen::Vector2d& at, StepCoordinates by, std::span<const StepSearch> known) {
  const Eigen::Vector2d here = sumAndProduct(at, by);
  return std::any_of(known.begin(), known.end(), [&](const StepSearch& minimum) {
    const Eigen::Vector2d there = sumAndProduct(minimum.at, minimum.by);
    return minimum.converged && std::abs(here[0] - there[0]) < kSame * there[0] &&
           std::abs(here[1] - there[1]) < kSame * there[0] * there[0];
  });
}

}  // namespace

StepSamples::StepSamples(std::vector<double> timeS, std::vector<double> values)
    : t_(std::move(timeS)), y_(std::move(values)) {
  sumTails();
}

void StepSamples::setWeights(std::vector<double> weights) {
  w_ = std::move(weights);
  sumTails();
}

StepSamples StepSamples::merged(double shareOfTime) const {
  std::vector<double> t, y, w;
  for (std::size_t i = 0; i < t_.size();) {
    const double until = t_[i] * (1.0 + shareOfTime);
    double sumT = 0.0, sumY = 0.0, count = 0.0;
    do {
      const double weight = w_.empty() ? 1.0 : w_[i];
      sumT += weight * t_[i];
      sumY += weight * y_[i];
      count += weight;
      ++i;
    } while (i < t_.size() && t_[i] < until);
    if (!(count > 0.0)) continue;
    t.push_back(sumT / count);
    y.push_back(sumY / count);
    w.push_back(count);
  }
  StepSamples samples(std::move(t), std::move(y));
  samples.setWeights(std::move(w));
  return samples;
}

void StepSamples::sumTails() {
  tails_.assign(t_.size() + 1, {});
  for (std::size_t i = t_.size(); i-- > 0;) {
    const double w = w_.empty() ? 1.0 : w_[i];
    Tail sum = tails_[i + 1];
    sum.one += w;
    sum.t += w * t_[i];
    sum.tt += w * t_[i] * t_[i];
    sum.y += w * y_[i];
    sum.ty += w * t_[i] * y_[i];
    sum.yy += w * y_[i] * y_[i];
    tails_[i] = sum;
  }
}

StepSamples::Moments StepSamples::moments(const Eigen::Vector2d& at, StepCoordinates by) const {
  const double first = std::exp(at[0]);
  const bool byTimes = by == StepCoordinates::kTimes;
  const double t1 = byTimes ? first * (1.0 + std::exp(at[1])) : first;
  const double d = at[1];
  const double slowest = byTimes   ? t1
                         : d < 1.0 ? first / std::max(d, 1e-3)
                                   : first * (d + std::sqrt(d * d - 1.0));
  const auto settled = static_cast<std::size_t>(
      std::upper_bound(t_.begin(), t_.end(), kStepSearchSettled * slowest) - t_.begin());
  Moments s;
  const auto add = [&s](const StepShape& shape, double t, double y, double w) {
    const double p = w * shape.phi, a = w * shape.derivativeByFirst,
                 b = w * shape.derivativeBySecond;
    s.pp += p * shape.phi;
    s.pt += p * t;
    s.py += p * y;
    s.ap += a * shape.phi;
    s.at += a * t;
    s.ay += a * y;
    s.bp += b * shape.phi;
    s.bt += b * t;
    s.by += b * y;
    s.aa += a * shape.derivativeByFirst;
    s.ab += a * shape.derivativeBySecond;
    s.bb += b * shape.derivativeBySecond;
  };
  const OverdampedShape overdamped(t1, first);
  for (std::size_t i = 0; i < settled; ++i)
    add(byTimes ? overdamped.at(t_[i]) : oscillatingShape(t_[i], first, d),
        t_[i],
        y_[i],
        w_.empty() ? 1.0 : w_[i]);
  const Tail& tail = tails_[settled];
  s.pp += tail.one;
  s.pt += tail.t;
  s.py += tail.y;
  s.tt = tails_[0].tt;
  s.ty = tails_[0].ty;
  s.yy = tails_[0].yy;
  return s;
}

StepSearch searchStep(const StepSamples& samples,
                      StepCoordinates by,
                      const Eigen::Vector2d& start,
                      const StepSearchBounds& bounds,
                      int maxIterations,
                      std::span<const StepSearch> known) {
  StepSearch search;
  search.by = by;
  search.at = start.cwiseMax(bounds.least).cwiseMin(bounds.most);
  StepSamples::Moments moments = samples.moments(search.at, by);
  ++search.evaluations;
  Linear linear = solveLinear(moments);
  double lambda = 1e-3;
  Normal normal = normalEquations(moments, linear);
  SecantPart secant;
  for (int i = 0; i < maxIterations && std::isfinite(linear.sumOfSquares); ++i) {
    const Eigen::Vector2d step = dampedStep(secant.completed(normal), lambda, search.at, bounds);
    const Eigen::Vector2d next = (search.at + step).cwiseMax(bounds.least).cwiseMin(bounds.most);
    const double moved = (next - search.at).cwiseAbs().maxCoeff();
    // What the linearised model promises: where that is nothing beside the sum itself, here is the
    // minimum.
    const double promised = std::abs(normal.gradient.dot(next - search.at));
    if (moved < 1e-10 || promised <= 1e-12 * linear.sumOfSquares) {
      search.converged = true;
      break;
    }
    const StepSamples::Moments tried = samples.moments(next, by);
    ++search.evaluations;
    const Linear triedLinear = solveLinear(tried);
    if (triedLinear.sumOfSquares <= linear.sumOfSquares) {
      const Normal triedNormal = normalEquations(tried, triedLinear);
      if (moved < kNear)
        secant.learn(next - search.at, normal.gradient, triedNormal);
      else
        secant.forget();
      search.at = next;
      moments = tried;
      linear = triedLinear;
      normal = triedNormal;
      lambda = std::max(lambda * 0.1, 1e-12);
      if (nearKnown(search.at, by, known)) {
        search.sameAsKnown = true;
        break;
      }
      if (by == StepCoordinates::kTimes && next[1] < kNearlyCritical) break;
    } else {
      // No descent left but rounding: the sums carry about 1e-16 of the squares of all values.
      if (triedLinear.sumOfSquares - linear.sumOfSquares <= 1e-15 * moments.yy && moved < 1e-5) {
        search.converged = true;
        break;
      }
      secant.forget();
      lambda = std::max(lambda * 8.0, 1e-6);
      if (lambda > 1e12) break;
    }
  }
  search.gain = linear.gain;
  search.drift = linear.drift;
  search.sumOfSquares = linear.sumOfSquares;
  return search;
}

}  // namespace palpate

#include "palpate/calibration/step_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "palpate/calibration/least_squares.h"
#include "palpate/calibration/student_t.h"
#include "palpate/core/number_text.h"

#include "calibration/step_search.h"

namespace palpate {
namespace {

constexpr double kStepFitNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kFewestSamples = 6;  // four parameters, and residuals to judge them
constexpr double kGainReached = 0.95;
constexpr double kCritical = 1.001;
constexpr double kHuberScale = 1.345, kCauchyScale = 2.385;
// An oscillating fit must reduce the sum of squares to this share of the overdamped one, since the
// physics of the rubber does not explain an oscillation.
constexpr double kOscillatingGain = 0.98;
// Time constants that differ by less than this share are equal.
constexpr double kEqualTimes = 1e-6;
// A correlation of neighbours above this leaves too few independent samples to be estimated.
constexpr double kMaxCorrelation = 0.98;
constexpr int kCorrelationHalvings = 10;
// K is determined when its 95 % interval is narrower than this share of it, to either side.
constexpr double kDeterminedShare = 0.5;
constexpr const char* kGainUnknown = "not identifiable: the data don't determine K";

double shortestInterval(std::span<const double> timeS) {
  double shortest = timeS.back() - timeS.front();
  for (std::size_t i = 1; i < timeS.size(); ++i)
    if (timeS[i] > timeS[i - 1]) shortest = std::min(shortest, timeS[i] - timeS[i - 1]);
  return shortest;
}

// A T2 below a hundredth of a frame changes nothing.
double leastT2Of(std::span<const double> timeS) { return 1e-2 * shortestInterval(timeS); }

StepSearchOptions searchOptionsOf(const StepSamples& samples,
                                  double leastT2S,
                                  const StepFitOptions& options,
                                  StepDomain domain) {
  const double duration = samples.timeS.back();
  // A time constant of many durations is a ramp.
  return {.domain = domain,
          .leastT2S = leastT2S,
          .mostS = 10.0 * duration,
          .maxIterations = options.maxIterations};
}

LeastSquaresLoss leastSquaresLossOf(const StepFitOptions& options) {
  return options.loss == StepLoss::kHuber    ? LeastSquaresLoss::kHuber
         : options.loss == StepLoss::kCauchy ? LeastSquaresLoss::kCauchy
                                             : LeastSquaresLoss::kSquares;
}

StepMinimum minimumOf(const StepSamples& samples, double leastT2S, const StepFitOptions& options) {
  StepSearchOptions search = searchOptionsOf(samples, leastT2S, options, StepDomain::kAperiodic);
  StepMinimum best = searchStep(samples, search);
  if (options.damping == StepDamping::kAny) {
    const auto swinging = searchOptionsOf(samples, leastT2S, options, StepDomain::kOscillating);
    StepMinimum other = searchStep(samples, swinging);
    const int evaluations = best.evaluations + other.evaluations;
    if (other.parameters.damping < 1.0 &&
        other.sumOfSquares < kOscillatingGain * best.sumOfSquares) {
      std::swap(best, other);
      search = swinging;
    }
    best.evaluations = evaluations;
    best.alternatives.insert(
        best.alternatives.end(), other.alternatives.begin(), other.alternatives.end());
  }
  if (options.loss == StepLoss::kSquares || !std::isfinite(best.sumOfSquares)) return best;
  const double deviations = options.lossScale > 0.0            ? options.lossScale
                            : options.loss == StepLoss::kHuber ? kHuberScale
                                                               : kCauchyScale;
  return searchRobustStep(samples, search, best, leastSquaresLossOf(options), deviations);
}

// Returns d phi / d T1 at fixed T2. derivativeBySecond is (T1 - T2) times this value; for equal
// time constants the limit is used.
double byT1(const StepShape& shape, double t, double t1, double t2) {
  if (t1 - t2 > kEqualTimes * t1) return shape.derivativeBySecond / (t1 - t2);
  const double s = t / t1;
  return -0.5 * s * s * std::exp(-s) / t1;
}

// Sums over the rows J_i of the derivatives for noise whose correlation is rho^|i - j|, and what
// they say about the residuals e = M noise that a fit with these derivatives leaves, M = 1 - J C
// J^T and C = (J^T J)^-1.
struct CorrelatedSums {
  Eigen::MatrixXd product;  // J^T R J
  double left = 0.0;        // E sum e_i^2, for noise of unit variance: tr(M R)
  double neighbours = 0.0;  // E sum e_i e_(i+1)
};

CorrelatedSums correlatedSumsOf(const Eigen::MatrixXd& jacobian,
                                const Eigen::MatrixXd& unit,
                                double rho) {
  const Eigen::Index n = jacobian.rows(), p = jacobian.cols();
  Eigen::MatrixXd correlated = jacobian;  // R J
  Eigen::RowVectorXd before = Eigen::RowVectorXd::Zero(p), behind = before;
  for (Eigen::Index i = 1; i < n && rho > 0.0; ++i) {
    before = rho * (before + jacobian.row(i - 1));
    behind = rho * (behind + jacobian.row(n - i));
    correlated.row(i) += before;
    correlated.row(n - 1 - i) += behind;
  }
  const auto shifted = [&](const Eigen::MatrixXd& other) -> Eigen::MatrixXd {
    return 0.5 * (jacobian.topRows(n - 1).transpose() * other.bottomRows(n - 1) +
                  jacobian.bottomRows(n - 1).transpose() * other.topRows(n - 1));
  };
  CorrelatedSums sums;
  sums.product = jacobian.transpose() * correlated;
  sums.left = static_cast<double>(n) - (unit * sums.product).trace();
  sums.neighbours = static_cast<double>(n - 1) * rho - 2.0 * (unit * shifted(correlated)).trace() +
                    (unit * shifted(jacobian) * unit * sums.product).trace();
  return sums;
}

// Residuals of real steps are correlated from frame to frame. Returns the correlation of
// neighbouring samples of the noise, as that of a first-order autoregression: the one for which the
// residuals, from which the fit has taken its part away, are expected to have the correlation that
// they have. Negative values are taken as 0: they would make intervals narrower.
double neighbourCorrelation(const Eigen::VectorXd& residuals,
                            const Eigen::MatrixXd& jacobian,
                            const Eigen::MatrixXd& unit) {
  const double squares = residuals.squaredNorm();
  if (!(squares > 0.0)) return 0.0;
  const Eigen::Index last = residuals.size() - 1;
  const double seen = residuals.head(last).dot(residuals.tail(last)) / squares;
  const auto isBelow = [&](double rho) {
    const CorrelatedSums sums = correlatedSumsOf(jacobian, unit, rho);
    return sums.neighbours < seen * sums.left;
  };
  if (!isBelow(0.0)) return 0.0;
  double low = 0.0, high = kMaxCorrelation;
  for (int i = 0; i < kCorrelationHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (isBelow(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Influences of the residuals (weight times residual; for squares the residual itself), and the
// mean derivative of the influence, which is 1 for squares.
struct StepInfluences {
  Eigen::VectorXd psi;
  double slope = 1.0;
};

StepInfluences influencesOf(const StepSamples& samples,
                            const StepMinimum& minimum,
                            LeastSquaresLoss loss) {
  StepInfluences influences;
  const std::size_t n = samples.timeS.size();
  influences.psi.resize(static_cast<Eigen::Index>(n));
  double slopes = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double residual = samples.values[i] - stepResponse(minimum.parameters, samples.timeS[i]);
    const double weight = minimum.weights.empty() ? 1.0 : minimum.weights[i];
    influences.psi[static_cast<Eigen::Index>(i)] = weight * residual;
    const double ratio = minimum.lossScale > 0.0 ? residual / minimum.lossScale : 0.0;
    if (loss == LeastSquaresLoss::kHuber)
      slopes += std::abs(ratio) <= 1.0 ? 1.0 : 0.0;
    else if (loss == LeastSquaresLoss::kCauchy)
      slopes += (1.0 - ratio * ratio) * weight * weight;
    else
      slopes += 1.0;
  }
  influences.slope = slopes / static_cast<double>(n);
  return influences;
}

struct StepCovariance {
  Eigen::Matrix4d parameters = Eigen::Matrix4d::Constant(kStepFitNaN);
  double commonTime = kStepFitNaN;  // variance of T when T1 = T2
  double freedom = 0.0;             // degrees of freedom of Student's t
  // Variances of K and m per unit variance of the noise, without correlation.
  Eigen::Vector2d uncorrelated = Eigen::Vector2d::Constant(kStepFitNaN);
};

// Covariance of K, m, T1, T2, or of K, m, T, d; NaN when it is singular. It is that of an estimate
// by influences psi with correlated noise, C = (J^T J)^-1 J^T R J (J^T J)^-1 E psi^2 / (E psi')^2
// (Huber, Robust Statistics, 1981, 7.6; for squares and R = 1 the usual one). Equal time constants
// have equal derivatives and can't be separated: those of T1 and T2 are NaN, and those of K and m
// follow from a model with one time constant.
StepCovariance covarianceOf(const StepSamples& samples,
                            const StepMinimum& minimum,
                            LeastSquaresLoss loss) {
  const StepParameters& p = minimum.parameters;
  const bool oscillating = p.damping < 1.0;
  const double t1 = p.t1S(), t2 = p.t2S();
  const bool equal = !oscillating && t1 - t2 <= kEqualTimes * t1;
  const int numParameters = equal ? 3 : 4, numKnown = equal ? 2 : 4;
  LeastSquaresProblem problem;
  problem.numResiduals = samples.timeS.size();
  problem.residuals = [&](std::span<const double>, std::span<double> out) {
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = samples.values[i] - stepResponse(p, samples.timeS[i]);
    return true;
  };
  problem.jacobian = [&](std::span<const double>, std::span<double> out) {
    for (std::size_t i = 0; i < samples.timeS.size(); ++i) {
      const double t = samples.timeS[i];
      const StepShape shape = oscillating ? oscillatingShape(t, p.timeConstantS, p.damping)
                                          : overdampedShape(t, t1, t2);
      // The derivatives by T and d; or by T1 and T2: log T2 and log(T1/T2 - 1) each keep the other
      // time constant.
      const double third =
          oscillating ? shape.derivativeByFirst / p.timeConstantS : byT1(shape, t, t1, t2);
      const double fourth = oscillating
                                ? shape.derivativeBySecond
                                : (shape.derivativeByFirst - t1 * byT1(shape, t, t1, t2)) / t2;
      const double gain = p.staticResponseCounts;
      const std::array row{
          -shape.phi, -t, -gain * (equal ? third + fourth : third), -gain * fourth};
      const auto size = static_cast<std::size_t>(numParameters);
      std::copy_n(row.begin(), size, &out[size * i]);
    }
    return true;
  };
  const Eigen::Vector4d x(p.staticResponseCounts,
                          p.driftCountsPerS,
                          oscillating ? p.timeConstantS : t1,
                          oscillating ? p.damping : t2);
  const Eigen::MatrixXd unit = unitCovariance(problem, x.head(numParameters));
  const auto n = static_cast<Eigen::Index>(samples.timeS.size());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(n, numParameters);
  problem.jacobian({}, {jacobian.data(), static_cast<std::size_t>(jacobian.size())});
  const StepInfluences influences =
      influencesOf(samples, minimum, minimum.lossScale > 0.0 ? loss : LeastSquaresLoss::kSquares);
  if (!unit.allFinite()) return {};
  const double rho = neighbourCorrelation(influences.psi, jacobian, unit);
  const CorrelatedSums sums = correlatedSumsOf(jacobian, unit, rho);
  StepCovariance covariance;
  // The mean of the squared influences is taken over the samples less what the parameters take
  // away, with one more for the common time constant that stands for two.
  const double left = sums.left - (equal ? 1.0 : 0.0);
  // The estimated variance scatters with the sum of squares and with the correlation, by
  // 2 (1 + rho^2) / (n (1 - rho^2)) and 4 / (n (1 - rho^2)) of its square; Student's t has the
  // degrees of freedom whose variance scatters as much (Satterthwaite, Biometrics Bulletin 2,
  // 1946).
  covariance.freedom =
      (static_cast<double>(n) - 4.0) * (1.0 - rho * rho) / (rho > 0.0 ? 3.0 + rho * rho : 1.0);
  if (!(left > 0.0) || !(influences.slope > 0.0)) return covariance;
  const double variance =
      influences.psi.squaredNorm() / left / (influences.slope * influences.slope);
  const Eigen::MatrixXd found = variance * (unit * sums.product * unit);
  covariance.parameters.topLeftCorner(numKnown, numKnown) = found.topLeftCorner(numKnown, numKnown);
  if (equal) covariance.commonTime = found(2, 2);
  covariance.uncorrelated = unit.diagonal().head<2>();
  return covariance;
}

// What is known of a fit beside its covariance.
struct StepKnowledge {
  double leastT2S, durationS, frameS;
  const StepCovariance& covariance;
  const std::vector<StepAlternative>& alternatives;
};

// The share of the gain at the data's end when T1 (d < 1: T) is `slowS`.
double reachedGain(const StepParameters& p, double durationS, double slowS) {
  if (p.damping < 1.0) return oscillatingShape(durationS, slowS, p.damping).phi;
  const double t1 = p.t1S(), t2 = p.t2S();
  return t1 - t2 <= kEqualTimes * t1 ? oscillatingShape(durationS, slowS, 1.0).phi
                                     : overdampedShape(durationS, slowS, t2).phi;
}

// The difference of T1 and T2 enters the shape by its square, whose interval is symmetric; the
// interval of the difference then is wider on one side, and reaches to T1 = T2 as soon as that of
// the square contains 0. Returns its larger half.
double halfIntervalOfDifference(double difference, double linearHalf) {
  const double share = 2.0 * linearHalf / difference;
  if (!(share < 1.0)) return difference * std::max(1.0, std::sqrt(1.0 + share) - 1.0);
  return difference * (1.0 - std::sqrt(1.0 - share));
}

// Widens the intervals of K and m to the shapes far from the minimum that explain the data as well
// (profile likelihood): there the covariance at the minimum says nothing. Such a shape's sum of
// squares is larger by at most t^2 times the parameter's variance over that for noise of unit size.
void widenToAlternatives(const StepKnowledge& known, double student, StepFit& fit) {
  const double least = static_cast<double>(fit.numSamples) * fit.rmse * fit.rmse;
  const StepParameters& p = fit.parameters;
  for (const StepAlternative& other : known.alternatives)
    for (int i = 0; i < 2; ++i) {
      const double allowed =
          student * student * fit.covariance(i, i) / known.covariance.uncorrelated[i];
      if (!(other.sumOfSquares - least <= allowed)) continue;
      const double away = i == 0 ? other.staticResponseCounts - p.staticResponseCounts
                                 : other.driftCountsPerS - p.driftCountsPerS;
      fit.halfIntervals[i] = std::max(fit.halfIntervals[i], std::abs(away));
      if (other.reachedGain < kGainReached) fit.steadyStateReached = false;
    }
}

void stateIntervals(const StepKnowledge& known, StepFit& fit) {
  const StepParameters& p = fit.parameters;
  const double student = studentQuantile975(fit.degreesOfFreedom);
  for (int i = 0; i < 4; ++i) fit.halfIntervals[i] = student * fit.sd(i);
  const bool oscillating = p.damping < 1.0;
  const double commonTime = known.covariance.commonTime;
  const double slow = oscillating ? p.timeConstantS : p.t1S();
  const double slowHalf =
      commonTime >= 0.0 ? student * std::sqrt(commonTime) : fit.halfIntervals[2];
  // What lies between two samples isn't known, but is no longer than their distance.
  const double slowest = slow + (slowHalf >= 0.0 ? slowHalf : std::max(known.frameS - slow, 0.0));
  fit.steadyStateReached = reachedGain(p, known.durationS, slowest) >= kGainReached;
  widenToAlternatives(known, student, fit);
  fit.gainUndetermined =
      !(fit.halfIntervals[0] < kDeterminedShare * std::abs(p.staticResponseCounts));
  fit.identifiable = fit.converged && !fit.gainUndetermined;
  if (!oscillating) {
    const Eigen::Matrix4d& c = fit.covariance;
    const double apart = c(2, 2) + c(3, 3) - 2.0 * c(2, 3);  // variance of T1 - T2
    const double half = halfIntervalOfDifference(p.t1S() - p.t2S(), student * std::sqrt(apart));
    for (int i = 2; i < 4; ++i)
      fit.halfIntervals[i] =
          std::sqrt(student * student * std::max(c(i, i) - 0.25 * apart, 0.0) + 0.25 * half * half);
  }
  if (!fit.identifiable) fit.halfIntervals.setConstant(kStepFitNaN);
}

void sayWhatIsMissing(const StepKnowledge& known, StepFit& fit) {
  const StepParameters& p = fit.parameters;
  const bool oscillating = p.damping < 1.0;
  const double third = oscillating ? p.timeConstantS : p.t1S();
  const double fourth = oscillating ? p.damping : p.t2S();
  if (!fit.converged && !fit.gainUndetermined)
    fit.notes.push_back("the fit did not converge: don't use its parameters");
  if (!fit.steadyStateReached) {
    const double reached = reachedGain(p, known.durationS, third);
    fit.notes.push_back(
        reached >= kGainReached
            ? "the gain may not be reached before the data end: K and m can't be separated"
            : "cut off before the gain is reached (" + fixedText(100.0 * reached, 0) +
                  " % of it): K and m can't be separated");
  }
  if (fit.gainUndetermined) fit.notes.push_back(kGainUnknown);
  const bool slow = fit.sd(2) < 0.5 * third;
  const bool fast = fit.sd(3) < 0.5 * fourth && (oscillating || fourth > 2.0 * known.leastT2S);
  fit.timesIdentifiable = fit.identifiable && slow && fast;
  if (fit.timesIdentifiable || !fit.identifiable) return;
  const double commonTimeSd = std::sqrt(known.covariance.commonTime);
  if (!oscillating && p.damping < kCritical && !(commonTimeSd >= 0.5 * p.timeConstantS))
    fit.notes.push_back(
        "T1 and T2 are so nearly equal (critically damped) that the data can't tell one from the "
        "other: use T, their geometric mean; K and m hold");
  else if (slow && !oscillating)
    fit.notes.push_back("T2 is not identifiable (far below the frame period of " +
                        fixedText(1e3 * known.frameS, 0) +
                        " ms): T and d have no meaning; K, m and T1 have");
  else
    fit.notes.push_back("the time constants are not identifiable; K and m are");
}

}  // namespace

void StepFitOptions::validate() const {
  if (!(lossScale >= 0.0) || !std::isfinite(lossScale))
    throw std::invalid_argument("StepFitOptions: lossScale must be 0 (automatic) or above, is " +
                                numberText(lossScale));
  if (maxIterations < 1)
    throw std::invalid_argument("StepFitOptions: maxIterations must be at least 1, is " +
                                std::to_string(maxIterations));
}

double StepFit::sd(int parameter) const {
  if (parameter < 0 || parameter > 3)
    throw std::out_of_range("StepFit: parameters are 0..3, not " + std::to_string(parameter));
  const double variance = covariance(parameter, parameter);
  return variance >= 0.0 ? std::sqrt(variance) : kStepFitNaN;
}

double StepFit::interval95(int parameter) const {
  if (parameter < 0 || parameter > 3)
    throw std::out_of_range("StepFit: parameters are 0..3, not " + std::to_string(parameter));
  return halfIntervals[parameter];
}

StepFit fitStep(std::span<const double> timeS,
                std::span<const double> values,
                const StepFitOptions& options) {
  options.validate();
  if (timeS.size() != values.size())
    throw std::invalid_argument("fitStep: " + std::to_string(timeS.size()) + " times, " +
                                std::to_string(values.size()) + " values");
  StepFit fit;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < timeS.size(); ++i)
    if (std::isfinite(timeS[i]) && std::isfinite(values[i]) && timeS[i] >= 0.0) order.push_back(i);
  fit.numSamples = order.size();
  fit.numDropped = timeS.size() - order.size();
  if (fit.numDropped > 0)
    fit.notes.push_back(std::to_string(fit.numDropped) + " of " + std::to_string(timeS.size()) +
                        " samples are not numbers or before the step: left out");
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return timeS[a] < timeS[b]; });
  std::vector<double> t, y;
  for (const std::size_t i : order) {
    t.push_back(timeS[i]);
    y.push_back(values[i]);
  }
  const bool varies = std::any_of(y.begin(), y.end(), [](double v) { return v != 0.0; });
  if (t.size() < kFewestSamples || !varies || !(t.back() > t.front())) {
    fit.notes.push_back(!varies && !y.empty()
                            ? "nothing but zeros: no step"
                            : "only " + std::to_string(t.size()) + " usable samples: a fit takes " +
                                  std::to_string(kFewestSamples));
    return fit;
  }
  const double durationS = t.back();
  const double frameS = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  const StepSamples samples{std::move(t), std::move(y)};
  const double leastT2S = leastT2Of(samples.timeS);
  const StepMinimum found = minimumOf(samples, leastT2S, options);
  fit.evaluations = found.evaluations;
  fit.converged = found.converged && std::isfinite(found.sumOfSquares);
  if (!std::isfinite(found.sumOfSquares)) {
    // Where shapes fit, but each search for the best one ends where phi is a straight line, K and m
    // can't be separated.
    fit.gainUndetermined = !found.alternatives.empty();
    fit.notes.push_back(fit.gainUndetermined ? kGainUnknown
                                             : "no step response fits these samples");
    return fit;
  }
  fit.parameters = found.parameters;
  double squares = 0.0, weighted = 0.0;
  for (std::size_t i = 0; i < samples.timeS.size(); ++i) {
    const double residual = samples.values[i] - stepResponse(fit.parameters, samples.timeS[i]);
    const double w = found.weights.empty() ? 1.0 : found.weights[i];
    squares += residual * residual;
    weighted += w * residual * residual;
    if (w < 0.5) ++fit.numDownweighted;
  }
  const auto n = static_cast<double>(samples.timeS.size());
  fit.rmse = std::sqrt(squares / n);
  fit.residualSd = std::sqrt(weighted / (n - 4.0));
  const StepCovariance covariance = covarianceOf(samples, found, leastSquaresLossOf(options));
  fit.covariance = covariance.parameters;
  fit.degreesOfFreedom = covariance.freedom;
  const StepKnowledge known{leastT2S, durationS, frameS, covariance, found.alternatives};
  stateIntervals(known, fit);
  sayWhatIsMissing(known, fit);
  return fit;
}

}  // namespace palpate

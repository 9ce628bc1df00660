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
      best = other;
      search = swinging;
    }
    best.evaluations = evaluations;
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

struct StepCovariance {
  Eigen::Matrix4d parameters = Eigen::Matrix4d::Constant(kStepFitNaN);
  double commonTime = kStepFitNaN;  // variance of T when T1 = T2
};

// Covariance of K, m, T1, T2, or of K, m, T, d, for unit variance of the residuals; NaN when it is
// singular. Equal time constants have equal derivatives and can't be separated: those of T1 and T2
// are NaN, and those of K and m follow from a model with one time constant.
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
  if (minimum.lossScale > 0.0) {
    problem.loss = loss;
    problem.lossScale = minimum.lossScale;
  }
  const Eigen::Vector4d x(p.staticResponseCounts,
                          p.driftCountsPerS,
                          oscillating ? p.timeConstantS : t1,
                          oscillating ? p.damping : t2);
  const Eigen::MatrixXd found = unitCovariance(problem, x.head(numParameters));
  StepCovariance covariance;
  covariance.parameters.topLeftCorner(numKnown, numKnown) = found.topLeftCorner(numKnown, numKnown);
  if (equal) covariance.commonTime = found(2, 2);
  return covariance;
}

// commonTimeSd is the standard deviation of T when T1 = T2, and NaN otherwise.
void sayWhatIsMissing(
    double leastT2S, double durationS, double frameS, double commonTimeSd, StepFit& fit) {
  const StepParameters& p = fit.parameters;
  const bool oscillating = p.damping < 1.0;
  const double phiAtEnd =
      p.staticResponseCounts == 0.0
          ? 0.0
          : (stepResponse(p, durationS) - p.driftCountsPerS * durationS) / p.staticResponseCounts;
  fit.steadyStateReached = phiAtEnd >= kGainReached;
  if (!fit.converged) fit.notes.push_back("the fit did not converge: don't use its parameters");
  if (!fit.steadyStateReached)
    fit.notes.push_back("cut off before the gain is reached (" + fixedText(100.0 * phiAtEnd, 0) +
                        " % of it): K and m can't be separated");
  const double third = oscillating ? p.timeConstantS : p.t1S();
  const double fourth = oscillating ? p.damping : p.t2S();
  const bool k = fit.sd(0) < 0.5 * std::abs(p.staticResponseCounts);
  const bool slow = fit.sd(2) < 0.5 * third;
  const bool fast = fit.sd(3) < 0.5 * fourth && (oscillating || fourth > 2.0 * leastT2S);
  fit.identifiable = fit.converged && k && slow && fast;
  if (fit.identifiable || !fit.converged) return;
  if (k && !oscillating && p.damping < kCritical && !(commonTimeSd >= 0.5 * p.timeConstantS))
    fit.notes.push_back("critically damped: T1 and T2 can't be separated, K, m and T can");
  else if (k && slow && !oscillating)
    fit.notes.push_back("T2 is not identifiable (far below the frame period of " +
                        fixedText(1e3 * frameS, 0) +
                        " ms): T and d have no meaning; K, m and T1 have");
  else if (k)
    fit.notes.push_back("the time constants are not identifiable; K and m are");
  else
    fit.notes.push_back("not identifiable: the data don't determine K");
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
  return studentQuantile975(static_cast<double>(numSamples) - 4.0) * sd(parameter);
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
                        " samples are no numbers or before the step: left out");
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
    fit.notes.push_back("no step response fits these samples");
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
  fit.covariance = fit.residualSd * fit.residualSd * covariance.parameters;
  const double commonTimeSd = fit.residualSd * std::sqrt(covariance.commonTime);
  sayWhatIsMissing(leastT2S, durationS, frameS, commonTimeSd, fit);
  return fit;
}

}  // namespace palpate

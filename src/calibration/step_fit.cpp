#include "palpate/calibration/step_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <Eigen/QR>

#include "palpate/calibration/student_t.h"
#include "palpate/core/number_text.h"

#include "calibration/step_search.h"

namespace palpate {
namespace {

constexpr double kStepFitNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kFewestSamples = 6;  // four parameters, and something left to judge them by
constexpr std::array<std::pair<double, double>, 4> kStartsS = {
    {{0.05, 0.02}, {0.2, 0.02}, {0.5, 0.05}, {1.0, 0.1}}};
constexpr double kMergedShare = 0.05;
// Minima on merged samples that are further above the best one than this stay so on all samples.
constexpr double kWorthRefining = 1.5;
constexpr double kGainReached = 0.95;
constexpr double kCritical = 1.001;
constexpr double kHuberScale = 1.345, kCauchyScale = 2.385;
constexpr double kSdPerMad = 1.4826;
constexpr int kMostReweightings = 25;
constexpr int kMostTurns = 4;
// An oscillating fit must be so much better to be believed: its two parameters have no reason in
// the rubber.
constexpr double kOscillatingGain = 0.98;

StepParameters parametersOf(const StepSearch& found) {
  const Eigen::Vector2d& at = found.at;
  const double first = std::exp(at[0]);
  StepParameters p;
  if (found.by == StepCoordinates::kDamping)
    p = {0.0, 0.0, first, at[1]};
  else
    p = StepParameters::ofTimes(0.0, 0.0, first * (1.0 + std::exp(at[1])), first);
  p.staticResponseCounts = found.gain;
  p.driftCountsPerS = found.drift;
  return p;
}

// Of searches by damping; beyond the most of an aperiodic one it goes on by times.
struct DampingRange {
  double least, most;
};
constexpr DampingRange kAperiodic{1.0, 1.2}, kOscillating{0.02, 1.0};

double shortestInterval(std::span<const double> timeS) {
  double shortest = timeS.back() - timeS.front();
  for (std::size_t i = 1; i < timeS.size(); ++i)
    if (timeS[i] > timeS[i - 1]) shortest = std::min(shortest, timeS[i] - timeS[i - 1]);
  return shortest;
}

class Fitter {
 public:
  Fitter(StepSamples samples, const StepFitOptions& options)
      : samples_(std::move(samples)), options_(options) {
    const double duration = samples_.timeS().back();
    // Below a hundredth of a frame T2 changes nothing; a time constant of many durations is a ramp.
    leastLog_ = std::log(1e-2 * shortestInterval(samples_.timeS()));
    mostLog_ = std::log(10.0 * duration);
  }

  // Four searches on merged samples, where each costs a fifth; what they find, on all samples.
  StepSearch best() {
    const StepSamples merged = samples_.merged(kMergedShare);
    std::vector<StepSearch> found;
    for (const auto& [t1, t2] : kStartsS) {
      StepSearch start;
      start.at = {std::log(t2), std::log(t1 / t2 - 1.0)};
      add(found, search(merged, start, kAperiodic, found));
    }
    StepSearch best = refined(found, kAperiodic);
    if (options_.damping == StepDamping::kAny) {
      std::vector<StepSearch> swinging;
      for (const auto& [t, d] : {std::pair(0.05, 0.7), std::pair(0.2, 0.3), std::pair(0.02, 0.3)}) {
        StepSearch start;
        start.by = StepCoordinates::kDamping;
        start.at = {std::log(t), d};
        add(swinging, search(merged, start, kOscillating, swinging));
      }
      const StepSearch other = refined(swinging, kOscillating);
      if (other.at[1] < 1.0 && other.sumOfSquares < kOscillatingGain * best.sumOfSquares)
        best = other;
    }
    return best;
  }

  // Iteratively reweighted squares from the fit without weights.
  StepSearch robust(StepSearch from, std::vector<double>& weights) {
    const double k = options_.lossScale > 0.0            ? options_.lossScale
                     : options_.loss == StepLoss::kHuber ? kHuberScale
                                                         : kCauchyScale;
    for (int i = 0; i < kMostReweightings; ++i) {
      const std::vector<double> residuals = residualsOf(parametersOf(from));
      std::vector<double> sizes(residuals.size());
      std::transform(
          residuals.begin(), residuals.end(), sizes.begin(), [](double r) { return std::abs(r); });
      std::nth_element(sizes.begin(),
                       sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2),
                       sizes.end());
      const double scale = kSdPerMad * sizes[sizes.size() / 2];
      if (!(scale > 0.0)) break;  // half of the samples are met exactly
      weights.resize(residuals.size());
      for (std::size_t s = 0; s < weights.size(); ++s) {
        const double u = std::abs(residuals[s]) / (k * scale);
        weights[s] =
            options_.loss == StepLoss::kHuber ? (u > 1.0 ? 1.0 / u : 1.0) : 1.0 / (1.0 + u * u);
      }
      samples_.setWeights(weights);
      const bool swings = from.by == StepCoordinates::kDamping && from.at[1] < 1.0;
      const StepSearch next = search(samples_, from, swings ? kOscillating : kAperiodic);
      const StepParameters was = parametersOf(from), is = parametersOf(next);
      const double moved = std::abs(std::log(is.timeConstantS / was.timeConstantS)) +
                           std::abs(std::log(is.damping / was.damping)) +
                           std::abs(is.staticResponseCounts / was.staticResponseCounts - 1.0);
      from = next;
      if (moved < 1e-7) break;
    }
    return from;
  }

  std::vector<double> residualsOf(const StepParameters& p) const {
    std::vector<double> residuals(samples_.size());
    for (std::size_t i = 0; i < residuals.size(); ++i)
      residuals[i] = samples_.values()[i] - stepResponse(p, samples_.timeS()[i]);
    return residuals;
  }

  // Of K, m, T1, T2 or K, m, T, d, for unit variance of the residuals; NaN where it is singular.
  Eigen::Matrix4d unitCovariance(const StepParameters& p) const {
    const bool oscillating = p.damping < 1.0;
    const double t1 = p.t1S(), t2 = p.t2S();
    Eigen::Matrix<double, Eigen::Dynamic, 4> jacobian(static_cast<Eigen::Index>(samples_.size()),
                                                      4);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const double t = samples_.timeS()[i];
      const StepShape shape = oscillating ? oscillatingShape(t, p.timeConstantS, p.damping)
                                          : overdampedShape(t, t1, t2);
      const double root = samples_.weights().empty() ? 1.0 : std::sqrt(samples_.weights()[i]);
      // By T and d; or by T1 and T2: v = log(T1/T2 - 1), u = log T2 keep the other time constant.
      const double third =
          oscillating ? shape.derivativeByFirst / p.timeConstantS : byT1(shape, t, t1, t2);
      const double fourth = oscillating
                                ? shape.derivativeBySecond
                                : (shape.derivativeByFirst - t1 * byT1(shape, t, t1, t2)) / t2;
      jacobian.row(static_cast<Eigen::Index>(i)) =
          root * Eigen::RowVector4d(
                     shape.phi, t, p.staticResponseCounts * third, p.staticResponseCounts * fourth);
    }
    const Eigen::RowVector4d size = jacobian.colwise().norm();
    if (!(size.minCoeff() > 0.0) || !size.allFinite())
      return Eigen::Matrix4d::Constant(kStepFitNaN);
    for (int c = 0; c < 4; ++c) jacobian.col(c) /= size[c];
    const Eigen::HouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, 4>> qr(jacobian);
    const Eigen::Matrix4d r = qr.matrixQR().topRows<4>().triangularView<Eigen::Upper>();
    if (!(r.diagonal().cwiseAbs().minCoeff() > 1e-12))
      return Eigen::Matrix4d::Constant(kStepFitNaN);
    const Eigen::Matrix4d inverse =
        r.triangularView<Eigen::Upper>().solve(Eigen::Matrix4d::Identity());
    const Eigen::Matrix4d covariance = inverse * inverse.transpose();
    return covariance.cwiseQuotient(size.transpose() * size);
  }

  int evaluations() const noexcept { return evaluations_; }
  double leastT2S() const { return std::exp(leastLog_); }

 private:
  // d phi / d T1 at fixed T2. derivativeBySecond is (T1 - T2) times it; where they are equal, the
  // limit.
  static double byT1(const StepShape& shape, double t, double t1, double t2) {
    if (t1 - t2 > 1e-6 * t1) return shape.derivativeBySecond / (t1 - t2);
    const double s = t / t1;
    return -0.5 * s * s * std::exp(-s) / t1;
  }
  void add(std::vector<StepSearch>& found, const StepSearch& search) {
    if (!search.sameAsKnown) found.push_back(search);
  }
  StepSearch refined(const std::vector<StepSearch>& found, DampingRange range) {
    double least = std::numeric_limits<double>::infinity();
    for (const StepSearch& one : found) least = std::min(least, one.sumOfSquares);
    StepSearch best;
    best.sumOfSquares = std::numeric_limits<double>::infinity();
    for (const StepSearch& one : found) {
      if (!(one.sumOfSquares <= kWorthRefining * least)) continue;
      const StepSearch better = search(samples_, one, range);
      if (better.sumOfSquares < best.sumOfSquares) best = better;
    }
    return best;
  }

  // Goes on by damping where the search by times comes near d = 1, and back where it leaves again.
  StepSearch search(const StepSamples& samples,
                    const StepSearch& start,
                    DampingRange range,
                    std::span<const StepSearch> known = {}) {
    const StepSearchBounds byTimes{{leastLog_, -5.0}, {mostLog_, 16.0}};
    const StepSearchBounds byDamping{{leastLog_, range.least}, {mostLog_, range.most}};
    StepSearch found = start;
    for (int turn = 0; turn < kMostTurns; ++turn) {
      const bool times = found.by == StepCoordinates::kTimes;
      found = searchStep(
          samples, found.by, found.at, times ? byTimes : byDamping, options_.maxIterations, known);
      evaluations_ += found.evaluations;
      const bool leaves = !times && range.most > 1.0 && found.at[1] >= range.most;
      if (found.sameAsKnown || (found.converged && !leaves)) break;
      const StepParameters p = parametersOf(found);
      if (times && p.damping < range.most) {
        found.by = StepCoordinates::kDamping;
        found.at = {std::log(p.timeConstantS), p.damping};
      } else if (leaves) {
        found.by = StepCoordinates::kTimes;
        found.at = {std::log(p.t2S()), std::log(p.t1S() / p.t2S() - 1.0)};
      } else {
        break;
      }
    }
    return found;
  }

  StepSamples samples_;
  StepFitOptions options_;
  double leastLog_ = 0.0, mostLog_ = 0.0;
  int evaluations_ = 0;
};

void sayWhatIsMissing(const Fitter& fitter, double durationS, double frameS, StepFit& fit) {
  const StepParameters& p = fit.parameters;
  const bool oscillating = p.damping < 1.0;
  const double phiAtEnd =
      p.staticResponseCounts == 0.0
          ? 0.0
          : (stepResponse(p, durationS) - p.driftCountsPerS * durationS) / p.staticResponseCounts;
  fit.steadyStateReached = phiAtEnd >= kGainReached;
  if (!fit.converged)
    fit.notes.push_back("the fit did not converge: no parameter is to be trusted");
  if (!fit.steadyStateReached)
    fit.notes.push_back("cut off before the gain is reached (" + fixedText(100.0 * phiAtEnd, 0) +
                        " % of it): K and m can't be told apart");
  const double third = oscillating ? p.timeConstantS : p.t1S();
  const double fourth = oscillating ? p.damping : p.t2S();
  const bool k = fit.sd(0) < 0.5 * std::abs(p.staticResponseCounts);
  const bool slow = fit.sd(2) < 0.5 * third;
  const bool fast = fit.sd(3) < 0.5 * fourth && (oscillating || fourth > 2.0 * fitter.leastT2S());
  fit.identifiable = fit.converged && k && slow && fast;
  if (fit.identifiable || !fit.converged) return;
  if (k && !oscillating && p.damping < kCritical)
    fit.notes.push_back("critically damped: T1 and T2 can't be told apart, K, m and T can");
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
  Fitter fitter(StepSamples(std::move(t), std::move(y)), options);
  StepSearch found = fitter.best();
  std::vector<double> weights;
  if (options.loss != StepLoss::kSquares && std::isfinite(found.sumOfSquares))
    found = fitter.robust(found, weights);
  fit.evaluations = fitter.evaluations();
  fit.converged = found.converged && std::isfinite(found.sumOfSquares);
  if (!std::isfinite(found.sumOfSquares)) {
    fit.notes.push_back("no step response fits these samples");
    return fit;
  }
  fit.parameters = parametersOf(found);
  double squares = 0.0, weighted = 0.0;
  const std::vector<double> residuals = fitter.residualsOf(fit.parameters);
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    squares += residuals[i] * residuals[i];
    weighted += w * residuals[i] * residuals[i];
    if (w < 0.5) ++fit.numDownweighted;
  }
  const auto n = static_cast<double>(residuals.size());
  fit.rmse = std::sqrt(squares / n);
  fit.residualSd = std::sqrt(weighted / (n - 4.0));
  fit.covariance = fit.residualSd * fit.residualSd * fitter.unitCovariance(fit.parameters);
  sayWhatIsMissing(fitter, durationS, frameS, fit);
  return fit;
}

}  // namespace palpate

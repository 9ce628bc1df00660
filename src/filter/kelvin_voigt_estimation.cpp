#include "palpate/filter/kelvin_voigt_estimation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <Eigen/Dense>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"

#include "filter/kelvin_voigt_pass.h"
#include "filter/sample_stretches.h"

namespace palpate {
namespace {

constexpr double kNoiseFloor = 1e-9;  // of the mean square
constexpr double kStepLog = 1e-3;     // for differences in the logarithm of a parameter
constexpr double kLargestStep = 1.0;  // of a Newton step in a logarithm
constexpr int kHalvings = 12;
constexpr double kWidestPace = 1e8;  // largest ratio of a parameter to its start, or the inverse

// Sums over all transitions with one interval: E(x x^T) of the previous state, E(w x^T) and E(w
// w^T), with w = x' - F x for the transition F of the E step. (The same sums of x' itself would be
// differences of large numbers.)
struct Transitions {
  KelvinVoigtStep step = {};  // F
  double intervalS = 0.0;
  std::size_t count = 0;
  double beforeYy = 0.0, beforeYv = 0.0, beforeVv = 0.0;
  double crossYy = 0.0, crossYv = 0.0, crossVy = 0.0, crossVv = 0.0;
  double afterYy = 0.0, afterYv = 0.0, afterVv = 0.0;

  void add(const KelvinVoigtState& x, const KelvinVoigtMoment& next);
};

void Transitions::add(const KelvinVoigtState& x, const KelvinVoigtMoment& next) {
  const KelvinVoigtStep& s = step;
  const KelvinVoigtState& after = next.state;
  const double wY = after.y - s.fYy * x.y - s.fYv * x.v;
  const double wV = after.v - s.fVy * x.y - s.fVv * x.v;
  // F P, and Cov(w, x) = C - F P.
  const double fpYy = s.fYy * x.pYy + s.fYv * x.pYv, fpYv = s.fYy * x.pYv + s.fYv * x.pVv;
  const double fpVy = s.fVy * x.pYy + s.fVv * x.pYv, fpVv = s.fVy * x.pYv + s.fVv * x.pVv;
  const double wxYy = next.cYy - fpYy, wxYv = next.cYv - fpYv;
  const double wxVy = next.cVy - fpVy, wxVv = next.cVv - fpVv;
  ++count;
  beforeYy += x.y * x.y + x.pYy;
  beforeYv += x.y * x.v + x.pYv;
  beforeVv += x.v * x.v + x.pVv;
  crossYy += wY * x.y + wxYy;
  crossYv += wY * x.v + wxYv;
  crossVy += wV * x.y + wxVy;
  crossVv += wV * x.v + wxVv;
  // Cov(w) = P' - C F^T - F Cov(x, w).
  afterYy +=
      wY * wY + after.pYy - (next.cYy * s.fYy + next.cYv * s.fYv) - (s.fYy * wxYy + s.fYv * wxYv);
  afterYv +=
      wY * wV + after.pYv - (next.cYy * s.fVy + next.cYv * s.fVv) - (s.fYy * wxVy + s.fYv * wxVv);
  afterVv +=
      wV * wV + after.pVv - (next.cVy * s.fVy + next.cVv * s.fVv) - (s.fVy * wxVy + s.fVv * wxVv);
}

struct Expectation {
  std::vector<Transitions> transitions;
  std::size_t numTransitions = 0;
  double residual = 0.0;  // sum of E(z - y)^2
  std::size_t numValues = 0;
  double logLikelihood = 0.0;
};

// The model is searched in the logarithms of m, E and eta; parameters that are zero stay zero.
enum Parameter { kMass, kStiffness, kViscosity };
double& parameterOf(KelvinVoigtModel& model, Parameter which) {
  return which == kMass ? model.mass : which == kStiffness ? model.stiffness : model.viscosity;
}

struct Series {
  std::span<const double> timeS, values;
  std::vector<SampleRange> stretches;
};

class Estimation {
 public:
  Estimation(const Series& series, const KelvinVoigtEstimationOptions& options)
      : series_(series), options_(options) {
    // The M step treats transitions of one interval together, so the intervals are sorted once.
    for (const SampleRange& stretch : series.stretches)
      for (std::size_t i = stretch.begin + 1; i < stretch.end; ++i)
        intervals_.push_back(series.timeS[i] - series.timeS[i - 1]);
    std::sort(intervals_.begin(), intervals_.end());
    intervals_.erase(std::unique(intervals_.begin(), intervals_.end()), intervals_.end());
    // When no given parameter fixes the unit of force, m = 1 does.
    const bool forceless = options.stiffness.value_or(0.0) == 0.0 &&
                           options.viscosity.value_or(0.0) == 0.0 && !options.forceNoise;
    if (!options.mass && !forceless) free_.push_back(kMass);
    if (!options.stiffness) free_.push_back(kStiffness);
    if (!options.viscosity) free_.push_back(kViscosity);
  }

  bool start(KelvinVoigtModel& model);
  void expect(const KelvinVoigtModel& model, Expectation& out);
  void maximise(const Expectation& expectation, KelvinVoigtModel& model);

 private:
  double dynamicPart(const Expectation& expectation, KelvinVoigtModel& model) const;
  bool raise(const Expectation& expectation, KelvinVoigtModel& model, double& best) const;

  const Series& series_;
  const KelvinVoigtEstimationOptions& options_;
  std::vector<double> intervals_;
  std::vector<Parameter> free_;
  KelvinVoigtModel start_;
  double leastR_ = 0.0;
  double leastQ_ = 0.0;  // of S/m^2
  KelvinVoigtPass pass_;
};

double mean(double sum, std::size_t count) {
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

// Returns false when there is nothing to fit; the model then has the given parameters, and defaults
// for the others.
bool Estimation::start(KelvinVoigtModel& model) {
  double squares = 0.0, slopes = 0.0, bends = 0.0, least = std::numeric_limits<double>::max(),
         most = std::numeric_limits<double>::lowest();
  std::size_t numValues = 0, numBends = 0;
  for (const SampleRange& stretch : series_.stretches) {
    // Uses finite values only.
    std::array<double, 3> z{}, t{};
    std::size_t n = 0;
    for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
      const double value = series_.values[i];
      if (!std::isfinite(value)) continue;
      z = {z[1], z[2], value};
      t = {t[1], t[2], series_.timeS[i]};
      ++n;
      ++numValues;
      squares += value * value;
      least = std::min(least, value);
      most = std::max(most, value);
      if (n < 3) continue;
      // Difference of the middle value from the line between its neighbours; for a straight signal
      // its variance is r (1 + u^2 + (1-u)^2).
      const double u = (t[1] - t[0]) / (t[2] - t[0]);
      const double bend = z[1] - (1.0 - u) * z[0] - u * z[2];
      bends += bend * bend / (1.0 + u * u + (1.0 - u) * (1.0 - u));
      slopes += std::pow((z[2] - z[0]) / (t[2] - t[0]), 2);
      ++numBends;
    }
  }
  const bool usable = numBends > 0 && most > least;
  const double square = usable ? mean(squares, numValues) : 1.0;
  leastR_ = kNoiseFloor * square;
  const double r = usable ? std::max(0.5 * mean(bends, numBends), leastR_) : 1.0;
  model.measurementNoise = options_.measurementNoise.value_or(r);
  // In the stationary state E(v^2) / E(y^2) = E/m, and E(y^2) = S / (2 E eta).
  const double pace2 = usable ? std::max(mean(slopes, numBends) / square, 1e-6) : 400.0;
  const double pace = std::sqrt(pace2);
  const double e = options_.stiffness.value_or(0.0), eta = options_.viscosity.value_or(0.0);
  model.mass = options_.mass.value_or(e > 0.0 ? e / pace2 : eta > 0.0 ? 0.5 * eta / pace : 1.0);
  model.stiffness = options_.stiffness.value_or(model.mass * pace2);
  model.viscosity = options_.viscosity.value_or(2.0 * model.mass * pace);
  const double likelyE = std::max(model.stiffness, model.mass * pace2);
  const double likelyEta = std::max(model.viscosity, 1e-3 * model.mass * pace);
  model.forceNoise = options_.forceNoise.value_or(2.0 * likelyE * likelyEta * square);
  leastQ_ = kNoiseFloor * 2.0 * pace2 * pace * square;
  start_ = model;
  return usable;
}

void Estimation::expect(const KelvinVoigtModel& model, Expectation& out) {
  out = {.transitions = std::vector<Transitions>(intervals_.size())};
  for (const SampleRange& stretch : series_.stretches) {
    const auto times = series_.timeS.subspan(stretch.begin, stretch.end - stretch.begin);
    const auto values = series_.values.subspan(stretch.begin, stretch.end - stretch.begin);
    forwardPass(times, values, model, pass_);
    backwardPass(pass_);
    out.logLikelihood += pass_.logLikelihood;
    for (std::size_t i = 0; i < pass_.moments.size(); ++i) {
      const KelvinVoigtMoment& moment = pass_.moments[i];
      const KelvinVoigtState& x = moment.state;
      const double z = values[pass_.first + i];
      if (std::isfinite(z)) {
        out.residual += (z - x.y) * (z - x.y) + x.pYy;
        ++out.numValues;
      }
      if (i == 0) continue;
      const double interval = times[pass_.first + i] - times[pass_.first + i - 1];
      const auto found = std::lower_bound(intervals_.begin(), intervals_.end(), interval);
      Transitions& sum = out.transitions[static_cast<std::size_t>(found - intervals_.begin())];
      sum.intervalS = interval;
      sum.step = moment.step;
      sum.add(pass_.moments[i - 1].state, moment);
      ++out.numTransitions;
    }
  }
}

// The part of the expected log-density that depends on the dynamics, with the best S when S is free
// (S is then set in `model`).
double Estimation::dynamicPart(const Expectation& expectation, KelvinVoigtModel& model) const {
  const double a = model.stiffness / model.mass, b = model.viscosity / model.mass;
  double logs = 0.0, trace = 0.0;
  for (const Transitions& t : expectation.transitions) {
    if (t.count == 0) continue;
    const KelvinVoigtStep s = unitNoiseStep(a, b, t.intervalS);
    const double det = s.qYy * s.qVv - s.qYv * s.qYv;
    // S = E(w - D x)(w - D x)^T with D = the change of F.
    const double dYy = s.fYy - t.step.fYy, dYv = s.fYv - t.step.fYv;
    const double dVy = s.fVy - t.step.fVy, dVv = s.fVv - t.step.fVv;
    const double bYy = dYy * t.beforeYy + dYv * t.beforeYv;
    const double bYv = dYy * t.beforeYv + dYv * t.beforeVv;
    const double bVy = dVy * t.beforeYy + dVv * t.beforeYv;
    const double bVv = dVy * t.beforeYv + dVv * t.beforeVv;
    const double cYy = dYy * t.crossYy + dYv * t.crossYv;
    const double cYv = dYy * t.crossVy + dYv * t.crossVv;
    const double cVy = dVy * t.crossYy + dVv * t.crossYv;
    const double cVv = dVy * t.crossVy + dVv * t.crossVv;
    const double yy = t.afterYy - 2.0 * cYy + bYy * dYy + bYv * dYv;
    const double yv = t.afterYv - cYv - cVy + bYy * dVy + bYv * dVv;
    const double vv = t.afterVv - 2.0 * cVv + bVy * dVy + bVv * dVv;
    logs += static_cast<double>(t.count) * std::log(det);
    trace += (yy * s.qVv - 2.0 * yv * s.qYv + vv * s.qYy) / det;
  }
  const auto n = static_cast<double>(expectation.numTransitions);
  const double squareMass = model.mass * model.mass;
  if (!options_.forceNoise) model.forceNoise = std::max(trace / (2.0 * n), leastQ_) * squareMass;
  const double q = model.forceNoise / squareMass;
  return -0.5 * (logs + 2.0 * n * std::log(q) + trace / q);
}

// One Newton step in the logarithms of the free parameters, with derivatives by differences; a
// gradient step where the expression is not concave. Returns whether the expression was raised.
bool Estimation::raise(const Expectation& expectation,
                       KelvinVoigtModel& model,
                       double& best) const {
  const std::size_t n = free_.size();
  const auto moved = [&](const std::array<double, 3>& logs) {
    KelvinVoigtModel other = model;
    for (std::size_t i = 0; i < n; ++i) {
      double& value = parameterOf(other, free_[i]);
      KelvinVoigtModel begun = start_;
      const double from = parameterOf(begun, free_[i]);
      value = std::clamp(value * std::exp(logs[i]), from / kWidestPace, from * kWidestPace);
    }
    return other;
  };
  const auto at = [&](const std::array<double, 3>& logs) {
    KelvinVoigtModel other = moved(logs);
    return dynamicPart(expectation, other);
  };
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d curvature = -Eigen::Matrix3d::Identity();
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    std::array<double, 3> up{}, down{};
    up[i] = kStepLog;
    down[i] = -kStepLog;
    const double above = at(up), below = at(down);
    gradient(row) = (above - below) / (2.0 * kStepLog);
    curvature(row, row) = (above - 2.0 * best + below) / (kStepLog * kStepLog);
    for (std::size_t j = 0; j < i; ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      std::array<double, 3> pp = up, pm = up, mp = down, mm = down;
      pp[j] = mp[j] = kStepLog;
      pm[j] = mm[j] = -kStepLog;
      curvature(row, column) = curvature(column, row) =
          (at(pp) - at(pm) - at(mp) + at(mm)) / (4.0 * kStepLog * kStepLog);
    }
  }
  Eigen::Vector3d step = gradient.normalized();
  const Eigen::LLT<Eigen::Matrix3d> hill(-curvature);
  if (hill.info() == Eigen::Success) step = hill.solve(gradient);
  if (!step.allFinite() || gradient.norm() == 0.0) return false;
  const double largest = step.cwiseAbs().maxCoeff();
  if (largest > kLargestStep) step *= kLargestStep / largest;
  for (int i = 0; i < kHalvings; ++i, step *= 0.5) {
    KelvinVoigtModel other = moved({step(0), step(1), step(2)});
    const double value = dynamicPart(expectation, other);
    if (!(value > best)) continue;
    best = value;
    model = other;
    return true;
  }
  return false;
}

void Estimation::maximise(const Expectation& expectation, KelvinVoigtModel& model) {
  if (!options_.measurementNoise)
    model.measurementNoise = std::max(mean(expectation.residual, expectation.numValues), leastR_);
  double best = dynamicPart(expectation, model);  // sets S
  if (!free_.empty()) raise(expectation, model, best);
}

}  // namespace

void KelvinVoigtEstimationOptions::validate() const {
  KelvinVoigtModel model;
  model.mass = mass.value_or(model.mass);
  model.stiffness = stiffness.value_or(model.stiffness);
  model.viscosity = viscosity.value_or(model.viscosity);
  model.forceNoise = forceNoise.value_or(model.forceNoise);
  model.measurementNoise = measurementNoise.value_or(model.measurementNoise);
  model.validate();
  if (!(tolerance >= 0.0 && std::isfinite(tolerance)))
    throw std::invalid_argument("kelvin-voigt: tolerance must be 0 or above, is " +
                                std::to_string(tolerance));
  if (maxRounds < 1 || maxRounds > 100'000)
    throw std::invalid_argument("kelvin-voigt: rounds must be 1..100000, are " +
                                std::to_string(maxRounds));
}

KelvinVoigtEstimate estimateKelvinVoigt(std::span<const double> timeS,
                                        std::span<const double> values,
                                        const KelvinVoigtEstimationOptions& options,
                                        std::span<const std::size_t> gapSamples,
                                        const Progress& progress) {
  options.validate();
  validateTimes(timeS, values);
  const Series series{timeS, values, sampleStretches(values.size(), gapSamples)};
  Estimation estimation(series, options);
  KelvinVoigtEstimate estimate;
  if (!estimation.start(estimate.model)) return estimate;
  Expectation expectation;
  estimation.expect(estimate.model, expectation);
  estimate.logLikelihood.push_back(expectation.logLikelihood);
  estimate.end = KelvinVoigtEnd::kMaxRounds;
  const auto enough = options.tolerance * static_cast<double>(expectation.numValues);
  for (int round = 0; round < options.maxRounds; ++round) {
    reportProgress(
        progress, static_cast<std::size_t>(round), static_cast<std::size_t>(options.maxRounds));
    estimation.maximise(expectation, estimate.model);
    estimation.expect(estimate.model, expectation);
    const double gained = expectation.logLikelihood - estimate.logLikelihood.back();
    estimate.logLikelihood.push_back(expectation.logLikelihood);
    if (gained <= enough) {
      estimate.end = KelvinVoigtEnd::kConverged;
      break;
    }
  }
  return estimate;
}

}  // namespace palpate

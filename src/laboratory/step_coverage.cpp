#include "palpate/laboratory/step_coverage.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>

#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr double kSimulatedGain = 400.0;
constexpr double kOutlierSds = 10.0;
constexpr double kStampJitter = 0.25;  // of a frame

void requireOfSteps(bool holds, const char* field, double value) {
  if (!holds || !std::isfinite(value))
    throw std::invalid_argument(std::string("SimulatedSteps: ") + field + " is " +
                                numberText(value));
}

void validate(const SimulatedSteps& steps) {
  requireOfSteps(steps.truth.timeConstantS > 0.0, "time constant", steps.truth.timeConstantS);
  requireOfSteps(steps.truth.damping > 0.0, "damping", steps.truth.damping);
  requireOfSteps(true, "driftPerS", steps.driftPerS);
  requireOfSteps(steps.lengthS > 0.0 && steps.lengthS < 1e5, "lengthS", steps.lengthS);
  requireOfSteps(steps.noise >= 0.0, "noise", steps.noise);
  requireOfSteps(steps.correlationS >= 0.0, "correlationS", steps.correlationS);
  requireOfSteps(
      steps.outlierShare >= 0.0 && steps.outlierShare <= 1.0, "outlierShare", steps.outlierShare);
  requireOfSteps(steps.rateHz > 0.0 && steps.rateHz < 1e5, "rateHz", steps.rateHz);
}

StepParameters truthOf(const SimulatedSteps& steps) {
  StepParameters truth = steps.truth;
  truth.staticResponseCounts = kSimulatedGain;
  truth.driftCountsPerS = steps.driftPerS * kSimulatedGain;
  return truth;
}

std::array<double, 4> valuesOf(const StepParameters& p, bool oscillating) {
  return {p.staticResponseCounts,
          p.driftCountsPerS,
          oscillating ? p.timeConstantS : p.t1S(),
          oscillating ? p.damping : p.t2S()};
}

}  // namespace

SimulatedSamples simulateStep(const SimulatedSteps& steps, std::uint64_t seed) {
  validate(steps);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> jitter(-kStampJitter, kStampJitter), share(0.0, 1.0);
  const StepParameters truth = truthOf(steps);
  const double sd = steps.noise * kSimulatedGain;
  SimulatedSamples samples;
  double noise = 0.0, before = 0.0;
  for (int i = 0; i < steps.lengthS * steps.rateHz; ++i) {
    const double t = i == 0 ? 0.0 : (i + jitter(random)) / steps.rateHz;
    const double kept =
        i == 0 || steps.correlationS == 0.0 ? 0.0 : std::exp((before - t) / steps.correlationS);
    noise = kept * noise + std::sqrt(1.0 - kept * kept) * normal(random);
    const double outlier =
        share(random) < steps.outlierShare ? (share(random) < 0.5 ? -1.0 : 1.0) * kOutlierSds : 0.0;
    samples.timeS.push_back(t);
    samples.values.push_back(stepResponse(truth, t) + sd * (noise + outlier));
    before = t;
  }
  return samples;
}

StepCoverage measureStepCoverage(const SimulatedSteps& steps,
                                 std::size_t trials,
                                 std::uint64_t seed) {
  StepCoverage coverage;
  coverage.steps = steps;
  coverage.trials = trials;
  const StepParameters truth = truthOf(steps);
  for (std::size_t trial = 0; trial < trials; ++trial) {
    const SimulatedSamples samples = simulateStep(steps, seed + trial);
    const StepFit fit = fitStep(samples.timeS, samples.values, steps.fit);
    if (!fit.converged && !fit.gainUndetermined) ++coverage.notConverged;
    if (fit.gainUndetermined) ++coverage.notIdentifiable;
    if (!fit.steadyStateReached) ++coverage.cutOff;
    if (fit.usable()) ++coverage.usable;
    if (fit.usable() && !fit.identifiable) ++coverage.contradictory;
    if (!fit.converged) continue;
    // A fit that doesn't oscillate states T1 and T2, which an oscillating truth doesn't have.
    const bool oscillating = truth.damping < 1.0;
    const int known = oscillating == (fit.parameters.damping < 1.0) ? 4 : 2;
    const auto is = valuesOf(fit.parameters, oscillating), should = valuesOf(truth, oscillating);
    for (int i = 0; i < known; ++i) {
      const double half = fit.interval95(i);
      if (!std::isfinite(half)) continue;
      const auto at = static_cast<std::size_t>(i);
      const bool inside = std::abs(is[at] - should[at]) <= half;
      for (auto* counts : {&coverage.stated, &coverage.ofUsable}) {
        if (counts == &coverage.ofUsable && !fit.usable()) continue;
        ++(*counts)[at].stated;
        if (inside) ++(*counts)[at].inside;
      }
    }
  }
  return coverage;
}

std::vector<SimulatedSteps> coverageGrid() {
  struct Shape {
    const char* name;
    StepParameters truth;
  };
  const std::array shapes{
      Shape{"T1 0.5 s, T2 0.12 s", StepParameters::ofTimes(1.0, 0.0, 0.5, 0.12)},
      Shape{"T1 0.5 s, T2 0.005 s", StepParameters::ofTimes(1.0, 0.0, 0.5, 0.005)},
      Shape{"T1 = T2 = 0.3 s", {1.0, 0.0, 0.3, 1.0}},
      Shape{"T 0.2 s, d 0.5", {1.0, 0.0, 0.2, 0.5}},
  };
  std::vector<SimulatedSteps> grid;
  for (const Shape& shape : shapes)
    for (const double correlationS : {0.0, 0.1})
      for (const double noise : {0.005, 0.03, 0.1})
        for (const double lengthS : {1.0, 3.0, 12.0})
          for (const double driftPerS : {0.0, 0.03}) {
            SimulatedSteps steps;
            steps.shape = shape.name;
            steps.truth = shape.truth;
            steps.driftPerS = driftPerS;
            steps.lengthS = lengthS;
            steps.noise = noise;
            steps.correlationS = correlationS;
            if (shape.truth.damping < 1.0) steps.fit.damping = StepDamping::kAny;
            grid.push_back(steps);
          }
  for (const StepLoss loss : {StepLoss::kHuber, StepLoss::kCauchy})
    for (const double correlationS : {0.0, 0.1})
      for (const double lengthS : {3.0, 12.0}) {
        SimulatedSteps steps;
        steps.shape = shapes[0].name;
        steps.truth = shapes[0].truth;
        steps.driftPerS = 0.03;
        steps.lengthS = lengthS;
        steps.correlationS = correlationS;
        steps.outlierShare = 0.05;
        steps.fit.loss = loss;
        grid.push_back(steps);
      }
  return grid;
}

}  // namespace palpate

// Simulates loading steps whose parameters are known, fits them, and counts how often the stated
// 95 % intervals contain the truth, and what the fits say of themselves. `palpate step-benchmark`
// prints it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <palpate/calibration/step_fit.h>
#include <palpate/calibration/step_model.h>

namespace palpate {

// Loading steps of one kind. K is 400 counts; all else is relative to it or in seconds.
struct SimulatedSteps {
  std::string shape;          // name of the time constants
  StepParameters truth;       // its time constants; K and m are those below
  double driftPerS = 0.0;     // m / K [1/s]
  double lengthS = 12.0;      // > 0
  double noise = 0.03;        // standard deviation / K, >= 0
  double correlationS = 0.0;  // time in which the noise's correlation falls to 1/e [s]; 0: white
  double outlierShare = 0.0;  // 0 .. 1: share of samples that are off by 10 standard deviations
  double rateHz = 31.7;       // > 0; the stamps jitter by a quarter of a frame
  StepFitOptions fit = {};
};

// How often a stated 95 % interval contained the truth.
struct IntervalCoverage {
  std::size_t stated = 0, inside = 0;
};

struct StepCoverage {
  SimulatedSteps steps;
  std::size_t trials = 0;
  std::size_t usable = 0;
  std::size_t notIdentifiable = 0;  // the data don't determine K
  std::size_t cutOff = 0;           // the gain isn't reached, or may not be
  std::size_t notConverged = 0;     // of the others, those for which no minimum was found
  std::size_t contradictory = 0;    // usable and not identifiable at once
  // K, m, T1, T2 (an oscillating step: K, m, T, d), over the fits that state an interval.
  std::array<IntervalCoverage, 4> stated;
  // The same over the usable fits.
  std::array<IntervalCoverage, 4> ofUsable;
};

// Time [s] and signal [counts].
struct SimulatedSamples {
  std::vector<double> timeS, values;
};
// Returns the samples of one simulated step. Throws std::invalid_argument that names the field.
SimulatedSamples simulateStep(const SimulatedSteps& steps, std::uint64_t seed);

// Fits `trials` simulated steps; the same seed gives the same result. Throws std::invalid_argument.
StepCoverage measureStepCoverage(const SimulatedSteps& steps,
                                 std::size_t trials,
                                 std::uint64_t seed);

// The benchmark's grid: four shapes by noise, length and drift, with white and with correlated
// noise; and steps with outliers, fitted with each robust loss.
std::vector<SimulatedSteps> coverageGrid();

}  // namespace palpate

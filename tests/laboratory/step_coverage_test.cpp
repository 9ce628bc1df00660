#include "palpate/laboratory/step_coverage.h"

#include <cmath>
#include <set>
#include <stdexcept>

#include "testing/testing.h"

namespace palpate::step_coverage_test {
namespace {

SimulatedSteps stepsOf(double t1S, double t2S) {
  SimulatedSteps steps;
  steps.truth = StepParameters::ofTimes(1.0, 0.0, t1S, t2S);
  return steps;
}

TEST(StepCoverage, SimulatesTheModelWithItsNoise) {
  SimulatedSteps steps = stepsOf(0.5, 0.12);
  steps.driftPerS = 0.02;
  steps.noise = 0.0;
  const SimulatedSamples clean = simulateStep(steps, 1);
  ASSERT_EQ(clean.timeS.size(), 381u);  // 12 s of 31.7 frames
  for (std::size_t i = 0; i < clean.timeS.size(); ++i) {
    const double t = clean.timeS[i];
    const double phi = 1.0 - (0.5 * std::exp(-t / 0.5) - 0.12 * std::exp(-t / 0.12)) / 0.38;
    EXPECT_NEAR(clean.values[i], 400.0 * phi + 8.0 * t, 1e-9);
  }
  steps.noise = 0.05;
  for (const double correlationS : {0.0, 0.1}) {
    steps.correlationS = correlationS;
    double squares = 0.0, neighbours = 0.0, before = 0.0;
    std::size_t n = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const SimulatedSamples noisy = simulateStep(steps, seed);
      SimulatedSteps silent = steps;
      silent.noise = 0.0;
      const SimulatedSamples truth = simulateStep(silent, seed);
      for (std::size_t i = 0; i < noisy.timeS.size(); ++i, ++n) {
        const double noise = noisy.values[i] - truth.values[i];
        squares += noise * noise;
        neighbours += i > 0 ? noise * before : 0.0;
        before = noise;
      }
    }
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(n)), 20.0, 0.6);
    EXPECT_NEAR(neighbours / squares,
                correlationS == 0.0 ? 0.0 : std::exp(-1.0 / 31.7 / correlationS),
                0.02);
  }
}

TEST(StepCoverage, CountsWhatTheFitsState) {
  const StepCoverage good = measureStepCoverage(stepsOf(0.5, 0.12), 200, 7);
  EXPECT_EQ(good.trials, 200u);
  EXPECT_EQ(good.usable, 200u);
  EXPECT_EQ(good.notIdentifiable + good.cutOff + good.notConverged + good.contradictory, 0u);
  for (const IntervalCoverage& one : good.stated) {
    EXPECT_EQ(one.stated, 200u);
    EXPECT_GE(one.inside, 180u);
  }
  SimulatedSteps early = stepsOf(0.5, 0.12);
  early.lengthS = 0.7;
  early.noise = 0.1;
  const StepCoverage cut = measureStepCoverage(early, 100, 7);
  EXPECT_EQ(cut.usable, 0u);
  EXPECT_GE(cut.notIdentifiable, 90u);
  EXPECT_LE(cut.stated[0].stated, 10u);
  EXPECT_EQ(cut.ofUsable[0].stated, 0u);
}

TEST(StepCoverage, NoStepOfTheGridIsUsableAndNotIdentifiable) {
  std::set<std::string> shapes;
  std::size_t usable = 0, unknown = 0;
  for (const SimulatedSteps& steps : coverageGrid()) {
    shapes.insert(steps.shape);
    const StepCoverage coverage = measureStepCoverage(steps, 10, 11);
    EXPECT_EQ(coverage.contradictory, 0u);
    usable += coverage.usable;
    unknown += coverage.notIdentifiable;
  }
  EXPECT_EQ(shapes.size(), 4u);
  EXPECT_GE(usable, 500u);
  EXPECT_GE(unknown, 200u);
}

TEST(StepCoverage, IsTheSameForTheSameSeed) {
  const StepCoverage one = measureStepCoverage(stepsOf(0.5, 0.12), 40, 3);
  const StepCoverage same = measureStepCoverage(stepsOf(0.5, 0.12), 40, 3);
  EXPECT_EQ(one.stated[0].inside, same.stated[0].inside);
  EXPECT_NE(simulateStep(stepsOf(0.5, 0.12), 3).values, simulateStep(stepsOf(0.5, 0.12), 4).values);
}

TEST(StepCoverage, RefusesWhatIsNoStep) {
  for (const auto change : {+[](SimulatedSteps& s) { s.lengthS = 0.0; },
                            +[](SimulatedSteps& s) { s.noise = -1.0; },
                            +[](SimulatedSteps& s) { s.correlationS = std::nan(""); },
                            +[](SimulatedSteps& s) { s.outlierShare = 1.5; },
                            +[](SimulatedSteps& s) { s.rateHz = 0.0; },
                            +[](SimulatedSteps& s) { s.truth.timeConstantS = 0.0; }}) {
    SimulatedSteps steps = stepsOf(0.5, 0.12);
    change(steps);
    EXPECT_THROW(simulateStep(steps, 1), std::invalid_argument);
  }
}

}  // namespace
}  // namespace palpate::step_coverage_test

#include "palpate/calibration/step_model.h"

#include <cmath>
#include <utility>

#include "testing/testing.h"

namespace palpate::step_model_test {
namespace {

// phi(t) by integrating T^2 y'' + 2 d T y' + y = 1 from rest (study, eq. 3.1): classical
// Runge-Kutta.
double integrated(double timeConstantS, double damping, double untilS) {
  const int steps = 20'000;
  const double h = untilS / steps;
  double y = 0.0, v = 0.0;
  const auto rate = [&](double position, double speed) {
    return (1.0 - position - 2.0 * damping * timeConstantS * speed) /
           (timeConstantS * timeConstantS);
  };
  for (int i = 0; i < steps; ++i) {
    const double v1 = v, a1 = rate(y, v);
    const double v2 = v + 0.5 * h * a1, a2 = rate(y + 0.5 * h * v1, v2);
    const double v3 = v + 0.5 * h * a2, a3 = rate(y + 0.5 * h * v2, v3);
    const double v4 = v + h * a3, a4 = rate(y + h * v3, v4);
    y += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
    v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
  return y;
}

TEST(StepModel, SolvesItsDifferentialEquationInAllThreeCases) {
  for (const double damping : {0.3, 0.9, 1.0, 1.1, 2.5})
    for (const double t : {0.05, 0.3, 1.0, 2.0})
      EXPECT_NEAR(stepResponse({1.0, 0.0, 0.2, damping}, t), integrated(0.2, damping, t), 1e-9)
          << damping << " at " << t;
}

TEST(StepModel, IsTheFormulaOfTheStudyAboveOne) {
  const double t1 = 0.5, t2 = 0.1, k = 400.0, m = 12.0;
  const StepParameters p = StepParameters::ofTimes(k, m, t1, t2);
  EXPECT_NEAR(p.timeConstantS, std::sqrt(0.05), 1e-15);
  EXPECT_NEAR(p.damping, 0.6 / (2.0 * std::sqrt(0.05)), 1e-14);
  EXPECT_NEAR(p.t1S(), t1, 1e-14);
  EXPECT_NEAR(p.t2S(), t2, 1e-14);
  for (const double t : {0.0, 0.01, 0.2, 1.0, 9.0})
    EXPECT_NEAR(stepResponse(p, t),
                k - k / (t1 - t2) * (t1 * std::exp(-t / t1) - t2 * std::exp(-t / t2)) + m * t,
                1e-10);
}

TEST(StepModel, PassesSmoothlyThroughTheCriticalCase) {
  for (const double t : {0.1, 0.4, 1.3}) {
    const double critical = 1.0 - (1.0 + t / 0.2) * std::exp(-t / 0.2);
    EXPECT_NEAR(stepResponse({1.0, 0.0, 0.2, 1.0}, t), critical, 1e-14);
    EXPECT_NEAR(stepResponse({1.0, 0.0, 0.2, 1.0 + 1e-9}, t), critical, 1e-8);
    EXPECT_NEAR(stepResponse({1.0, 0.0, 0.2, 1.0 - 1e-9}, t), critical, 1e-8);
    // The same shape by times and by damping.
    const StepParameters p{1.0, 0.0, 0.2, 1.15};
    EXPECT_NEAR(
        overdampedShape(t, p.t1S(), p.t2S()).phi, oscillatingShape(t, 0.2, 1.15).phi, 1e-12);
  }
}

TEST(StepModel, IsZeroBeforeTheStepAndHasNoTimesWhereItOscillates) {
  const StepParameters p{100.0, 5.0, 0.2, 2.0};
  EXPECT_EQ(stepResponse(p, -1.0), 0.0);
  EXPECT_EQ(stepResponse(p, 0.0), 0.0);
  EXPECT_TRUE(std::isnan((StepParameters{100.0, 5.0, 0.2, 0.5}.t1S())));
  EXPECT_TRUE(std::isnan((StepParameters{100.0, 5.0, 0.2, 0.5}.t2S())));
}

// Central differences over the parameters that each derivative names.
TEST(StepModel, DerivativesAgreeWithDifferences) {
  const double h = 1e-5;
  for (const double t : {0.03, 0.2, 0.9, 3.0}) {
    for (const auto& [t1, t2] :
         {std::pair(0.6, 0.1), std::pair(0.3, 0.29), std::pair(0.3, 0.001)}) {
      const StepShape shape = overdampedShape(t, t1, t2);
      const double up = std::exp(h), ratio = t1 / t2 - 1.0;
      const auto phi = [&](double a, double b) { return overdampedShape(t, a, b).phi; };
      EXPECT_NEAR(
          shape.derivativeByFirst, (phi(t1 * up, t2 * up) - phi(t1 / up, t2 / up)) / (2 * h), 1e-8);
      EXPECT_NEAR(shape.derivativeBySecond,
                  (phi(t2 * (1 + ratio * up), t2) - phi(t2 * (1 + ratio / up), t2)) / (2 * h),
                  1e-8);
      const double rate =
          (overdampedShape(t + h * t2, t1, t2).phi - overdampedShape(t - h * t2, t1, t2).phi) /
          (2 * h * t2);
      EXPECT_NEAR(shape.rate, rate, 1e-6);
    }
    for (const double d : {0.2, 0.95, 1.0, 1.1}) {
      const StepShape shape = oscillatingShape(t, 0.25, d);
      const auto phi = [&](double a, double b) { return oscillatingShape(t, a, b).phi; };
      EXPECT_NEAR(shape.derivativeByFirst,
                  (phi(0.25 * std::exp(h), d) - phi(0.25 * std::exp(-h), d)) / (2 * h),
                  1e-8);
      EXPECT_NEAR(shape.derivativeBySecond, (phi(0.25, d + h) - phi(0.25, d - h)) / (2 * h), 1e-8);
    }
  }
}

TEST(StepModel, ReadsOffWhatTheCurveSays) {
  // T1 = .5, T2 = .1: t_i = .05 / .4 ln 5 (study, 3.1).
  const StepParameters p = StepParameters::ofTimes(400.0, 12.0, 0.5, 0.1);
  const StepCharacteristics c = characteristicsOf(p);
  EXPECT_NEAR(c.inflectionS, 0.125 * std::log(5.0), 1e-12);
  // The second derivative changes its sign there.
  const auto bend = [&](double t) {
    return stepResponseRate(p, t + 1e-4) - stepResponseRate(p, t - 1e-4);
  };
  EXPECT_GT(bend(c.inflectionS - 0.01), 0.0);
  EXPECT_LT(bend(c.inflectionS + 0.01), 0.0);
  EXPECT_NEAR(c.inflectionCounts, stepResponse(p, c.inflectionS), 1e-12);
  // The tangent there meets 0 at the dead time and K at t_k.
  const auto tangent = [&](double t) {
    return c.inflectionCounts + c.tangentPerS * (t - c.inflectionS);
  };
  EXPECT_NEAR(tangent(c.deadTimeS), 0.0, 1e-9);
  EXPECT_NEAR(tangent(c.tangentAtGainS), 400.0, 1e-9);
  EXPECT_NEAR(c.equivalentTangentPerS, stepResponse(p, c.tangentAtGainS) / c.tangentAtGainS, 1e-9);
  EXPECT_NEAR(stepResponse(p, c.steadyS), 400.0, 1e-6) << "a(t) = K";
}

TEST(StepModel, KnowsTheInflectionOfAllThreeCases) {
  EXPECT_NEAR(characteristicsOf({1.0, 0.0, 0.2, 1.0}).inflectionS, 0.2, 1e-9) << "T where d = 1";
  EXPECT_NEAR(characteristicsOf({1.0, 0.0, 0.2, 1.0 + 1e-10}).inflectionS, 0.2, 1e-5);
  EXPECT_NEAR(characteristicsOf({1.0, 0.0, 0.2, 0.5}).inflectionS,
              std::acos(0.5) * 0.2 / std::sqrt(0.75),
              1e-12);
}

TEST(StepModel, WithoutDriftItIsSteadyWherePhiMissesOnePerCent) {
  const StepParameters p = StepParameters::ofTimes(400.0, 0.0, 0.5, 0.1);
  EXPECT_NEAR(stepResponse(p, characteristicsOf(p).steadyS), 0.99 * 400.0, 1e-6);
  const StepParameters falling = StepParameters::ofTimes(400.0, -3.0, 0.5, 0.1);
  EXPECT_NEAR(characteristicsOf(falling).steadyS, characteristicsOf(p).steadyS, 1e-9);
}

}  // namespace
}  // namespace palpate::step_model_test

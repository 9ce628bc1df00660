#include "palpate/filter/kelvin_voigt_estimation.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include <Eigen/Dense>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::kelvin_voigt_estimation_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Series {
  std::vector<double> timeS, values, truth;
};

// What the model makes of its own noise, at uneven times around 74 Hz.
Series simulated(const KelvinVoigtModel& model,
                 std::size_t n,
                 unsigned seed = 1,
                 bool even = false) {
  std::mt19937 random(seed);
  std::normal_distribution<double> unit;
  std::uniform_real_distribution<double> interval(0.007, 0.020);
  Series series;
  double t = 0.0;
  Eigen::Vector2d x = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) {
      const double dt = even ? 0.0135 : interval(random);
      t += dt;
      const auto s = kelvinVoigtStep(model, dt);
      Eigen::Matrix2d f, q;
      f << s.fYy, s.fYv, s.fVy, s.fVv;
      q << s.qYy, s.qYv, s.qYv, s.qVv;
      const Eigen::Matrix2d root = q.llt().matrixL();
      x = f * x + root * Eigen::Vector2d(unit(random), unit(random));
    }
    series.timeS.push_back(t);
    series.truth.push_back(x(0));
    series.values.push_back(x(0) + std::sqrt(model.measurementNoise) * unit(random));
  }
  return series;
}

// 3 Hz, damping 0.25; position sd about 200 counts.
KelvinVoigtModel swinging() {
  const double pace = 2.0 * std::numbers::pi * 3.0;
  KelvinVoigtModel model{
      .mass = 1.0, .stiffness = pace * pace, .viscosity = 0.5 * pace, .measurementNoise = 100.0};
  model.forceNoise = 2.0 * model.stiffness * model.viscosity * 200.0 * 200.0;
  return model;
}

void expectNeverFalls(const KelvinVoigtEstimate& estimate) {
  ASSERT_GE(estimate.logLikelihood.size(), 2u);
  for (std::size_t i = 1; i < estimate.logLikelihood.size(); ++i)
    EXPECT_GE(estimate.logLikelihood[i],
              estimate.logLikelihood[i - 1] - 1e-9 * std::abs(estimate.logLikelihood[i]))
        << "round " << i;
}

TEST(KelvinVoigtEstimation, LikelihoodNeverFallsWhateverIsGiven) {
  const Series series = simulated(swinging(), 300);
  std::vector<KelvinVoigtEstimationOptions> choices(1);
  choices.push_back({.mass = 3.0});
  choices.push_back({.stiffness = 1000.0});
  choices.push_back({.viscosity = 5.0});
  choices.push_back({.mass = 0.2, .viscosity = 40.0});
  choices.push_back({.stiffness = 5000.0, .viscosity = 1.0});
  choices.push_back({.mass = 1.0, .stiffness = 10.0, .viscosity = 100.0});
  choices.push_back({.stiffness = 0.0});
  choices.push_back({.stiffness = 0.0, .viscosity = 0.0});
  choices.push_back({.forceNoise = 1e7});
  choices.push_back({.measurementNoise = 900.0});
  choices.push_back({.mass = 1.0, .forceNoise = 1e6, .measurementNoise = 1.0});
  for (std::size_t i = 0; i < choices.size(); ++i) {
    SCOPED_TRACE(i);
    choices[i].maxRounds = 60;
    choices[i].tolerance = 0.0;
    const auto estimate = estimateKelvinVoigt(series.timeS, series.values, choices[i]);
    expectNeverFalls(estimate);
    EXPECT_NO_THROW(estimate.model.validate());
    // What was given stays.
    EXPECT_EQ(estimate.model.mass, choices[i].mass.value_or(estimate.model.mass));
    EXPECT_EQ(estimate.model.stiffness, choices[i].stiffness.value_or(estimate.model.stiffness));
    EXPECT_EQ(estimate.model.viscosity, choices[i].viscosity.value_or(estimate.model.viscosity));
    EXPECT_EQ(estimate.model.forceNoise, choices[i].forceNoise.value_or(estimate.model.forceNoise));
    // The last likelihood is that of the model.
    const auto smoothed = kelvinVoigtSmoothed(series.timeS, series.values, estimate.model);
    EXPECT_NEAR(smoothed.logLikelihood,
                estimate.logLikelihood.back(),
                1e-9 * std::abs(smoothed.logLikelihood));
  }
}

TEST(KelvinVoigtEstimation, FindsTheModelThatMadeALongSeries) {
  const KelvinVoigtModel truth = swinging();
  for (const bool even : {true, false}) {
    const Series series = simulated(truth, 8000, 4, even);
    const auto estimate =
        estimateKelvinVoigt(series.timeS, series.values, {.tolerance = 1e-8, .maxRounds = 1000});
    expectNeverFalls(estimate);
    EXPECT_EQ(estimate.end, KelvinVoigtEnd::kConverged);
    EXPECT_EQ(estimate.model.mass, 1.0);
    EXPECT_NEAR(estimate.model.naturalHz(), 3.0, 0.1);
    EXPECT_NEAR(estimate.model.damping(), 0.25, 0.04);
    EXPECT_NEAR(estimate.model.measurementNoise, 100.0, 8.0);
    EXPECT_NEAR(estimate.model.forceNoise / truth.forceNoise, 1.0, 0.15);
    // No worse than the truth explains it.
    EXPECT_GE(estimate.logLikelihood.back(),
              kelvinVoigtSmoothed(series.timeS, series.values, truth).logLikelihood);
  }
}

// At the top no parameter can be moved without loss: the M step's optimum is the likelihood's own.
TEST(KelvinVoigtEstimation, EndsWhereTheLikelihoodIsFlat) {
  const Series series = simulated(swinging(), 600, 9);
  const auto estimate =
      estimateKelvinVoigt(series.timeS, series.values, {.tolerance = 1e-11, .maxRounds = 5000});
  ASSERT_EQ(estimate.end, KelvinVoigtEnd::kConverged);
  const auto likelihood = [&](const KelvinVoigtModel& model) {
    return kelvinVoigtSmoothed(series.timeS, series.values, model).logLikelihood;
  };
  const double top = estimate.logLikelihood.back();
  for (double KelvinVoigtModel::*field : {&KelvinVoigtModel::stiffness,
                                          &KelvinVoigtModel::viscosity,
                                          &KelvinVoigtModel::forceNoise,
                                          &KelvinVoigtModel::measurementNoise})
    for (const double factor : {0.97, 1.03}) {
      KelvinVoigtModel other = estimate.model;
      other.*field *= factor;
      EXPECT_LT(likelihood(other), top);
    }
}

TEST(KelvinVoigtEstimation, MassesAndForcesScaleTogether) {
  const Series series = simulated(swinging(), 400, 2);
  const auto one = estimateKelvinVoigt(series.timeS, series.values);
  const auto five = estimateKelvinVoigt(series.timeS, series.values, {.mass = 5.0});
  EXPECT_NEAR(five.model.stiffness / one.model.stiffness, 5.0, 1e-3);
  EXPECT_NEAR(five.model.viscosity / one.model.viscosity, 5.0, 1e-3);
  EXPECT_NEAR(five.model.forceNoise / one.model.forceNoise, 25.0, 0.02);
  EXPECT_NEAR(five.logLikelihood.back(), one.logLikelihood.back(), 1e-3);
}

TEST(KelvinVoigtEstimation, SmoothsBetterThanTheValuesAre) {
  const Series series = simulated(swinging(), 2000, 6);
  const auto model = estimateKelvinVoigt(series.timeS, series.values).model;
  const auto smoothed = kelvinVoigtSmoothed(series.timeS, series.values, model);
  double raw = 0.0, left = 0.0, said = 0.0;
  for (std::size_t i = 0; i < 2000; ++i) {
    raw += std::pow(series.values[i] - series.truth[i], 2) / 2000.0;
    left += std::pow(smoothed.position[i] - series.truth[i], 2) / 2000.0;
    said += smoothed.variance[i] / 2000.0;
  }
  EXPECT_LT(left, 0.6 * raw);
  EXPECT_NEAR(left / said, 1.0, 0.15) << "as good as it says";
}

TEST(KelvinVoigtEstimation, GapsAndMissingValuesAreNoTransitions) {
  Series series = simulated(swinging(), 400, 3);
  for (std::size_t i = 200; i < 400; ++i) series.timeS[i] += 500.0;
  const std::vector<std::size_t> gap = {199};
  const auto apart = estimateKelvinVoigt(series.timeS, series.values, {}, gap);
  expectNeverFalls(apart);
  for (std::size_t i = 300; i < 400; ++i) series.timeS[i] += 7.0;
  const std::vector<std::size_t> gaps = {199, 299};
  EXPECT_NEAR(estimateKelvinVoigt(series.timeS, series.values, {}, gaps).model.naturalHz(),
              apart.model.naturalHz(),
              0.3);
  series.values[50] = series.values[51] = series.values[0] = kNan;
  expectNeverFalls(estimateKelvinVoigt(series.timeS, series.values, {}, gaps));
}

TEST(KelvinVoigtEstimation, SeriesWithNothingToFitGiveAModelThatWorks) {
  const auto start = [](const std::vector<double>& values,
                        const KelvinVoigtEstimationOptions& options = {}) {
    std::vector<double> timeS;
    for (std::size_t i = 0; i < values.size(); ++i) timeS.push_back(0.02 * static_cast<double>(i));
    const auto estimate = estimateKelvinVoigt(timeS, values, options);
    EXPECT_EQ(estimate.end, KelvinVoigtEnd::kNothingToFit);
    EXPECT_EQ(estimate.rounds(), 0u);
    EXPECT_NO_THROW(estimate.model.validate());
    for (const double y : kelvinVoigtFiltered(timeS, values, estimate.model))
      EXPECT_TRUE(std::isfinite(y) || !std::isfinite(values.front()));
    return estimate.model;
  };
  start({});
  start({5.0});
  start({5.0, 9.0});
  start(std::vector<double>(50, 0.0));
  start(std::vector<double>(50, 700.0));
  start(std::vector<double>(50, kNan));
  EXPECT_EQ(start({1.0, 2.0}, {.mass = 4.0, .stiffness = 9.0}).stiffness, 9.0);
  // The least that can be fitted.
  const std::vector<double> at = {0.0, 0.1, 0.2};
  expectNeverFalls(estimateKelvinVoigt(at, std::vector<double>{0.0, 0.0, 1.0}));
  // A step, as a taxel's first contact is; a straight line; whole counts that hardly move.
  Series odd;
  for (int i = 0; i < 200; ++i) odd.timeS.push_back(0.0135 * i);
  for (int kind = 0; kind < 3; ++kind) {
    odd.values.clear();
    for (int i = 0; i < 200; ++i)
      odd.values.push_back(kind == 0   ? (i < 100 ? 0.0 : 800.0)
                           : kind == 1 ? 4.0 * i
                                       : 100.0 + i % 2);
    SCOPED_TRACE(kind);
    const auto estimate = estimateKelvinVoigt(odd.timeS, odd.values);
    expectNeverFalls(estimate);
    EXPECT_NO_THROW(estimate.model.validate());
    for (const double y : kelvinVoigtFiltered(odd.timeS, odd.values, estimate.model))
      EXPECT_TRUE(std::isfinite(y));
  }
}

TEST(KelvinVoigtEstimation, RefusesWhatHasNoMeaningAndCanBeCancelled) {
  const Series series = simulated(swinging(), 50);
  const auto with = [&](const KelvinVoigtEstimationOptions& options) {
    return estimateKelvinVoigt(series.timeS, series.values, options);
  };
  EXPECT_THROW(with({.mass = 0.0}), std::invalid_argument);
  EXPECT_THROW(with({.stiffness = -1.0}), std::invalid_argument);
  EXPECT_THROW(with({.viscosity = kNan}), std::invalid_argument);
  EXPECT_THROW(with({.forceNoise = 0.0}), std::invalid_argument);
  EXPECT_THROW(with({.measurementNoise = -3.0}), std::invalid_argument);
  EXPECT_THROW(with({.tolerance = -1.0}), std::invalid_argument);
  EXPECT_THROW(with({.maxRounds = 0}), std::invalid_argument);
  EXPECT_THROW(estimateKelvinVoigt(series.timeS, std::vector<double>(3)), std::invalid_argument);
  EXPECT_THROW(
      estimateKelvinVoigt(series.timeS, series.values, {}, {}, [](double) { return false; }),
      Cancelled);
  EXPECT_EQ(with({.tolerance = 0.0, .maxRounds = 3}).rounds(), 3u);
  EXPECT_EQ(with({.tolerance = 0.0, .maxRounds = 3}).end, KelvinVoigtEnd::kMaxRounds);
}

}  // namespace
}  // namespace palpate::kelvin_voigt_estimation_test

#include "palpate/calibration/step_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <Eigen/LU>

#include "testing/testing.h"

namespace palpate::step_fit_test {
namespace {

struct Samples {
  std::vector<double> t, y;
};

// 31.7 frames/s whose stamps jitter by a quarter, as real ones do.
Samples samplesOf(const StepParameters& truth,
                  double durationS,
                  double noise,
                  std::mt19937_64& random,
                  double rateHz = 31.7) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> jitter(-0.25, 0.25);
  Samples samples;
  for (int i = 0; i < durationS * rateHz; ++i) {
    const double t = i == 0 ? 0.0 : (i + jitter(random)) / rateHz;
    samples.t.push_back(t);
    samples.y.push_back(stepResponse(truth, t) + noise * normal(random));
  }
  return samples;
}

double rmseOf(const Samples& samples, const StepParameters& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < samples.t.size(); ++i)
    sum += std::pow(samples.y[i] - stepResponse(p, samples.t[i]), 2);
  return std::sqrt(sum / static_cast<double>(samples.t.size()));
}

TEST(StepFit, FindsTheTruthWithoutNoise) {
  std::mt19937_64 random(1);
  const StepParameters truth = StepParameters::ofTimes(436.0, 12.4, 0.505, 0.0636);
  const Samples samples = samplesOf(truth, 12.0, 0.0, random);
  const StepFit fit = fitStep(samples.t, samples.y);
  EXPECT_TRUE(fit.converged);
  EXPECT_TRUE(fit.identifiable);
  EXPECT_TRUE(fit.timesIdentifiable);
  EXPECT_TRUE(fit.steadyStateReached);
  EXPECT_TRUE(fit.notes.empty());
  EXPECT_EQ(fit.numSamples, samples.t.size());
  EXPECT_NEAR(fit.parameters.staticResponseCounts, 436.0, 1e-6);
  EXPECT_NEAR(fit.parameters.driftCountsPerS, 12.4, 1e-7);
  EXPECT_NEAR(fit.parameters.t1S(), 0.505, 1e-8);
  EXPECT_NEAR(fit.parameters.t2S(), 0.0636, 1e-8);
  EXPECT_LT(fit.rmse, 1e-6);
}

// The range that 24 measured steps of a real hand span (golden/pressure_calibration.csv).
TEST(StepFit, FindsAThousandRandomTruths) {
  std::mt19937_64 random(2);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  int missed = 0, above = 0;
  for (int i = 0; i < 1000; ++i) {
    const double t1 = between(0.2, 1.1), t2 = between(0.01, 0.95 * std::min(t1, 0.3));
    const StepParameters truth =
        StepParameters::ofTimes(between(50.0, 850.0), between(2.0, 32.0), t1, t2);
    const Samples clean = samplesOf(truth, between(6.0, 14.0), 0.0, random);
    const StepFit exact = fitStep(clean.t, clean.y);
    const StepParameters& p = exact.parameters;
    if (!exact.converged ||
        std::abs(p.staticResponseCounts / truth.staticResponseCounts - 1.0) > 1e-5 ||
        std::abs(p.driftCountsPerS / truth.driftCountsPerS - 1.0) > 1e-4 ||
        std::abs(p.t1S() / t1 - 1.0) > 1e-2 || std::abs(p.t2S() / t2 - 1.0) > 1e-2)
      ++missed;
    // With noise no fit may be worse than the truth itself.
    const Samples noisy = samplesOf(truth, 10.0, 0.03 * truth.staticResponseCounts, random);
    const StepFit fit = fitStep(noisy.t, noisy.y);
    if (!fit.converged || fit.rmse > rmseOf(noisy, truth)) ++above;
  }
  EXPECT_EQ(missed, 0);
  EXPECT_EQ(above, 0);
}

TEST(StepFit, StatedIntervalsHoldTheTruthInNinetyFivePerCent) {
  std::mt19937_64 random(3);
  const StepParameters truth = StepParameters::ofTimes(436.0, 12.4, 0.505, 0.0836);
  const double values[] = {436.0, 12.4, 0.505};
  constexpr int kRuns = 3000;
  int inside[3] = {};
  for (int run = 0; run < kRuns; ++run) {
    const Samples samples = samplesOf(truth, 12.0, 11.5, random);
    const StepFit fit = fitStep(samples.t, samples.y);
    const double found[] = {
        fit.parameters.staticResponseCounts, fit.parameters.driftCountsPerS, fit.parameters.t1S()};
    for (int p = 0; p < 3; ++p)
      if (std::abs(found[p] - values[p]) <= fit.interval95(p)) ++inside[p];
  }
  for (int p = 0; p < 3; ++p) {
    EXPECT_GE(inside[p], 0.93 * kRuns) << "K, m, T1: " << p;
    EXPECT_LE(inside[p], 0.97 * kRuns) << "K, m, T1: " << p;
  }
}

// Residuals of real steps are correlated by 0.7 to 0.95 from frame to frame. Intervals for white
// noise would hold the truth in 40 to 50 % then.
TEST(StepFit, StatedIntervalsHoldTheTruthAlsoWhenTheNoiseIsCorrelated) {
  std::mt19937_64 random(31);
  std::normal_distribution<double> normal;
  const StepParameters truth = StepParameters::ofTimes(436.0, 12.4, 0.505, 0.0836);
  const double values[] = {436.0, 12.4, 0.505};
  constexpr int kRuns = 1000;
  for (const double correlation : {0.5, 0.8}) {
    int inside[3] = {};
    for (int run = 0; run < kRuns; ++run) {
      Samples samples = samplesOf(truth, 12.0, 0.0, random);
      double noise = 0.0;
      for (double& y : samples.y) {
        noise = correlation * noise + std::sqrt(1.0 - correlation * correlation) * normal(random);
        y += 11.5 * noise;
      }
      const StepFit fit = fitStep(samples.t, samples.y);
      const StepParameters& p = fit.parameters;
      const double found[] = {p.staticResponseCounts, p.driftCountsPerS, p.t1S()};
      for (int i = 0; i < 3; ++i)
        if (std::abs(found[i] - values[i]) <= fit.interval95(i)) ++inside[i];
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(inside[i], 0.92 * kRuns) << "K, m, T1: " << i << " at " << correlation;
      EXPECT_LE(inside[i], 0.985 * kRuns) << "K, m, T1: " << i << " at " << correlation;
    }
  }
}

TEST(StepFit, CovarianceIsThatOfRepeatedFits) {
  std::mt19937_64 random(4);
  const StepParameters truth = StepParameters::ofTimes(300.0, 8.0, 0.6, 0.12);
  constexpr int kRuns = 2000;
  Eigen::Matrix4d stated = Eigen::Matrix4d::Zero(), squares = Eigen::Matrix4d::Zero();
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (int run = 0; run < kRuns; ++run) {
    const Samples samples = samplesOf(truth, 10.0, 3.0, random);
    const StepFit fit = fitStep(samples.t, samples.y);
    const StepParameters& p = fit.parameters;
    const Eigen::Vector4d found(p.staticResponseCounts, p.driftCountsPerS, p.t1S(), p.t2S());
    stated += fit.covariance / kRuns;
    sum += found / kRuns;
    squares += found * found.transpose() / kRuns;
  }
  const Eigen::Matrix4d seen = squares - sum * sum.transpose();
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c)
      EXPECT_NEAR(stated(r, c), seen(r, c), 0.12 * std::sqrt(seen(r, r) * seen(c, c)))
          << r << ", " << c;
}

TEST(StepFit, FitsTheCriticalAndTheOscillatingCase) {
  std::mt19937_64 random(5);
  const StepParameters critical{500.0, 20.0, 0.22, 1.0};
  const Samples samples = samplesOf(critical, 6.0, 0.0, random);
  const StepFit fit = fitStep(samples.t, samples.y);
  EXPECT_TRUE(fit.converged);
  EXPECT_NEAR(fit.parameters.staticResponseCounts, 500.0, 1e-3);
  EXPECT_NEAR(fit.parameters.timeConstantS, 0.22, 1e-5);
  EXPECT_NEAR(fit.parameters.damping, 1.0, 1e-4);

  const StepParameters swinging{500.0, 20.0, 0.1, 0.4};
  const Samples other = samplesOf(swinging, 6.0, 2.0, random, 100.0);
  const StepFit over = fitStep(other.t, other.y);
  EXPECT_GE(over.parameters.damping, 1.0) << "unless it is asked for";
  StepFitOptions any;
  any.damping = StepDamping::kAny;
  const StepFit found = fitStep(other.t, other.y, any);
  EXPECT_TRUE(found.converged);
  EXPECT_TRUE(found.timesIdentifiable);
  EXPECT_NEAR(found.parameters.damping, 0.4, 3 * found.sd(3));
  EXPECT_NEAR(found.parameters.timeConstantS, 0.1, 3 * found.sd(2));
  EXPECT_LT(found.rmse, 2.2);
  // An overdamped step stays one.
  const Samples plain = samplesOf(StepParameters::ofTimes(300.0, 8.0, 0.6, 0.12), 8.0, 3.0, random);
  EXPECT_GE(fitStep(plain.t, plain.y, any).parameters.damping, 1.0);
}

// phi and d phi / dT of d = 1, and t: written down anew from step_model.h. The columns are -d r / d
// (K, m, T).
Eigen::MatrixX3d criticalColumns(const Samples& samples, double gain, double timeConstantS) {
  Eigen::MatrixX3d columns(samples.t.size(), 3);
  for (std::size_t i = 0; i < samples.t.size(); ++i) {
    const double s = samples.t[i] / timeConstantS;
    columns.row(static_cast<Eigen::Index>(i)) << 1.0 - (1.0 + s) * std::exp(-s), samples.t[i],
        -gain * s * s * std::exp(-s) / timeConstantS;
  }
  return columns;
}

// The sum of the products of neighbouring residuals.
double neighbourSum(const Samples& samples, const StepParameters& p) {
  double sum = 0.0, before = 0.0;
  for (std::size_t i = 0; i < samples.t.size(); ++i) {
    const double residual = samples.y[i] - stepResponse(p, samples.t[i]);
    sum += residual * before;
    before = residual;
  }
  return sum;
}

TEST(StepFit, KeepsTheIntervalsOfKAndMOfACriticallyDampedStep) {
  const StepParameters truth{300.0, 8.0, 0.3, 1.0};
  int critical = 0, white = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const Samples samples = samplesOf(truth, 12.0, 2.0, random);
    for (const StepLoss loss : {StepLoss::kSquares, StepLoss::kHuber}) {
      StepFitOptions options;
      options.loss = loss;
      const StepFit fit = fitStep(samples.t, samples.y, options);
      const StepParameters& p = fit.parameters;
      EXPECT_TRUE(fit.converged);
      EXPECT_NEAR(p.staticResponseCounts, 300.0, 4.5 * fit.sd(0));
      EXPECT_NEAR(p.driftCountsPerS, 8.0, 4.5 * fit.sd(1));
      for (const std::string& note : fit.notes)
        EXPECT_EQ(note.find("don't determine K"), std::string::npos) << note;
      if (p.damping != 1.0) continue;
      ++critical;
      EXPECT_TRUE(fit.identifiable);
      EXPECT_FALSE(fit.timesIdentifiable);
      ASSERT_EQ(fit.notes.size(), 1u);
      EXPECT_NE(fit.notes[0].find("nearly equal"), std::string::npos) << fit.notes[0];
      EXPECT_NE(fit.notes[0].find("use T, their geometric mean"), std::string::npos)
          << fit.notes[0];
      // T is what the note says it is.
      EXPECT_NEAR(p.timeConstantS, std::sqrt(p.t1S() * p.t2S()), 1e-9);
      EXPECT_TRUE(std::isnan(fit.sd(2)) && std::isnan(fit.sd(3)));
      if (loss != StepLoss::kSquares) continue;
      const Eigen::MatrixX3d columns =
          criticalColumns(samples, p.staticResponseCounts, p.timeConstantS);
      const double variance = std::pow(rmseOf(samples, p), 2) *
                              static_cast<double>(samples.t.size()) /
                              static_cast<double>(samples.t.size() - 4);
      const Eigen::Matrix3d unit = (columns.transpose() * columns).inverse();
      const Eigen::Matrix3d expected = variance * unit;
      // Neighbouring residuals that are no more correlated than those of white noise (that of the
      // fit is -tr C J^T S J for neighbours S) leave the usual covariance; others make it larger.
      const Eigen::Index last = columns.rows() - 1;
      const double neighbours =
          -(unit * columns.topRows(last).transpose() * columns.bottomRows(last)).trace();
      if (neighbourSum(samples, p) * static_cast<double>(columns.rows() - 3) >
          neighbours * std::pow(rmseOf(samples, p), 2) * static_cast<double>(columns.rows())) {
        EXPECT_GT(fit.covariance(0, 0), expected(0, 0));
        EXPECT_GT(fit.covariance(1, 1), expected(1, 1));
        continue;
      }
      ++white;
      for (int r = 0; r < 2; ++r)
        for (int c = 0; c < 2; ++c)
          EXPECT_NEAR(fit.covariance(r, c),
                      expected(r, c),
                      1e-6 * std::sqrt(expected(r, r) * expected(c, c)));
    }
  }
  EXPECT_GE(white, 5);
  EXPECT_GE(critical, 30) << "noise leads to d = 1 in about half of the fits";
}

// A load that is there from the second sample on: K is known, T only as far below a frame.
TEST(StepFit, DoesNotClaimATimeConstantThatNoSampleShows) {
  int equal = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Samples samples;
    for (int i = 0; i < 200; ++i) {
      samples.t.push_back(i / 31.7);
      samples.y.push_back(i == 0 ? 0.0 : 100.0 + 2.0 * normal(random));
    }
    const StepFit fit = fitStep(samples.t, samples.y);
    EXPECT_FALSE(fit.timesIdentifiable);
    if (fit.parameters.damping != 1.0 || fit.parameters.timeConstantS > 0.003) continue;
    ++equal;
    EXPECT_NEAR(fit.parameters.staticResponseCounts, 100.0, 4.5 * fit.sd(0));
    for (const std::string& note : fit.notes)
      EXPECT_EQ(note.find("K, m and T can"), std::string::npos) << note;
  }
  EXPECT_GE(equal, 1);
}

Samples withOutliers(std::uint64_t seed, std::size_t every, double counts) {
  std::mt19937_64 random(seed);
  Samples samples = samplesOf(StepParameters::ofTimes(300.0, 8.0, 0.6, 0.12), 12.0, 4.0, random);
  for (std::size_t i = 30; i < samples.y.size(); i += every) samples.y[i] += counts;
  return samples;
}

// The scale of a robust fit is a fixed point: with the scale of the residuals that are left, the
// weighted residuals are orthogonal to the derivatives by K and m, which are phi and t. Returns the
// larger cosine of the two angles.
double distanceFromSettled(const Samples& samples, const StepParameters& p, StepLoss loss) {
  const auto n = static_cast<Eigen::Index>(samples.t.size());
  Eigen::VectorXd residuals(n), phi(n), t(n);
  const double t1 = p.t1S(), t2 = p.t2S();
  for (Eigen::Index i = 0; i < n; ++i) {
    t[i] = samples.t[static_cast<std::size_t>(i)];
    phi[i] = 1.0 - (t1 * std::exp(-t[i] / t1) - t2 * std::exp(-t[i] / t2)) / (t1 - t2);
    residuals[i] = samples.y[static_cast<std::size_t>(i)] - p.staticResponseCounts * phi[i] -
                   p.driftCountsPerS * t[i];
  }
  Eigen::VectorXd sizes = residuals.cwiseAbs();
  std::sort(sizes.begin(), sizes.end());
  const bool huber = loss == StepLoss::kHuber;
  const double scale = (huber ? 1.345 : 2.385) * 1.4826 * sizes[n / 2];
  for (double& r : residuals) {
    const double ratio = std::abs(r) / scale;
    r *= huber ? 1.0 / std::max(ratio, 1.0) : 1.0 / (1.0 + ratio * ratio);
  }
  return std::max(std::abs(residuals.normalized().dot(phi.normalized())),
                  std::abs(residuals.normalized().dot(t.normalized())));
}

TEST(StepFit, RobustScalesSettle) {
  for (const std::size_t every : {12u, 6u, 4u, 3u})
    for (std::uint64_t seed = 0; seed < 10; ++seed)
      for (const StepLoss loss : {StepLoss::kHuber, StepLoss::kCauchy}) {
        SCOPED_TRACE(::testing::Message() << "every " << every << ", seed " << seed << ", loss "
                                          << static_cast<int>(loss));
        const Samples samples = withOutliers(seed, every, 60.0);
        StepFitOptions options;
        options.loss = loss;
        const StepFit fit = fitStep(samples.t, samples.y, options);
        EXPECT_TRUE(fit.converged);
        EXPECT_LT(distanceFromSettled(samples, fit.parameters, loss), 1e-6);
      }
}

// A third of the samples are far away: the scale shrinks slowly, in some fits too slowly.
TEST(StepFit, RobustFitsWhoseScaleDoesNotSettleHaveNotConverged) {
  int settled = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const Samples samples = withOutliers(seed, 3, 150.0);
    StepFitOptions options;
    options.loss = StepLoss::kCauchy;
    const StepFit fit = fitStep(samples.t, samples.y, options);
    if (!fit.converged) continue;
    ++settled;
    EXPECT_LT(distanceFromSettled(samples, fit.parameters, StepLoss::kCauchy), 1e-6);
  }
  EXPECT_GE(settled, 20);
}

TEST(StepFit, EndsARobustFitWhoseSearchDidNotConverge) {
  const Samples samples = withOutliers(11, 12, 150.0);
  StepFitOptions options;
  options.maxIterations = 2;
  const StepFit plain = fitStep(samples.t, samples.y, options);
  for (const StepLoss loss : {StepLoss::kHuber, StepLoss::kCauchy}) {
    options.loss = loss;
    const StepFit robust = fitStep(samples.t, samples.y, options);
    EXPECT_FALSE(robust.converged);
    EXPECT_LE(robust.evaluations, plain.evaluations + 8) << "one search of two iterations";
    ASSERT_FALSE(robust.notes.empty());
    EXPECT_NE(robust.notes[0].find("did not converge"), std::string::npos);
  }
}

TEST(StepFit, RobustLossesShrugOffOutliers) {
  std::mt19937_64 random(6);
  const StepParameters truth = StepParameters::ofTimes(300.0, 8.0, 0.6, 0.12);
  Samples samples = samplesOf(truth, 12.0, 2.0, random);
  for (std::size_t i = 30; i < samples.y.size(); i += 12) samples.y[i] += 150.0;
  const StepFit plain = fitStep(samples.t, samples.y);
  EXPECT_GT(std::abs(plain.parameters.staticResponseCounts - 300.0), 5.0);
  for (const StepLoss loss : {StepLoss::kHuber, StepLoss::kCauchy}) {
    StepFitOptions options;
    options.loss = loss;
    const StepFit robust = fitStep(samples.t, samples.y, options);
    EXPECT_TRUE(robust.converged);
    EXPECT_NEAR(robust.parameters.staticResponseCounts, 300.0, 1.5);
    EXPECT_NEAR(robust.parameters.driftCountsPerS, 8.0, 0.2);
    EXPECT_GE(robust.numDownweighted, 25u);
    EXPECT_LE(robust.numDownweighted, 60u);
  }
}

TEST(StepFit, SaysThatT2IsNotIdentifiableFarBelowTheFramePeriod) {
  std::mt19937_64 random(7);
  int said = 0;
  for (int run = 0; run < 100; ++run) {
    const Samples samples =
        samplesOf(StepParameters::ofTimes(57.0, 2.9, 0.71, 1e-6), 12.0, 1.8, random);
    const StepFit fit = fitStep(samples.t, samples.y);
    EXPECT_TRUE(fit.converged);
    EXPECT_TRUE(fit.usable()) << "K and m are sound";
    EXPECT_NEAR(fit.parameters.staticResponseCounts, 57.0, 5 * fit.sd(0));
    if (!fit.timesIdentifiable && fit.notes.size() == 1 &&
        fit.notes[0].find("T2 is not identifiable") != std::string::npos)
      ++said;
  }
  EXPECT_GE(said, 95) << "noise alone looks like a T2 of two standard deviations now and then";
}

TEST(StepFit, SaysThatAStepWasCutOffBeforeItsGain) {
  std::mt19937_64 random(8);
  const Samples samples =
      samplesOf(StepParameters::ofTimes(400.0, 10.0, 1.0, 0.1), 1.5, 4.0, random);
  const StepFit fit = fitStep(samples.t, samples.y);
  EXPECT_FALSE(fit.steadyStateReached);
  EXPECT_FALSE(fit.usable());
  ASSERT_FALSE(fit.notes.empty());
  EXPECT_NE(fit.notes[0].find("cut off before the gain"), std::string::npos);
}

// Steps of a second whose noise is a tenth of K: a slower lag explains them as well as a larger
// drift does. Neither a search that ends without a minimum nor a lucky shape hides that.
TEST(StepFit, SaysOfShortNoisyStepsThatNothingDeterminesK) {
  int withoutMinimum = 0;
  for (std::uint64_t seed = 0; seed < 900; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const Samples samples =
        samplesOf(StepParameters::ofTimes(400.0, 12.0, 0.3, 0.299), 1.0, 40.0, random);
    const StepFit fit = fitStep(samples.t, samples.y);
    EXPECT_FALSE(fit.usable() && !fit.identifiable);
    ASSERT_FALSE(fit.notes.empty());
    if (fit.converged) continue;
    ++withoutMinimum;
    EXPECT_TRUE(fit.gainUndetermined);
    EXPECT_EQ(fit.notes.back(), "not identifiable: the data don't determine K");
    for (const std::string& note : fit.notes)
      EXPECT_EQ(note.find("did not converge"), std::string::npos) << note;
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(std::isnan(fit.interval95(i)));
  }
  EXPECT_GE(withoutMinimum, 5);
}

TEST(StepFit, LeavesOutWhatIsNoNumberAndTakesAnyOrder) {
  std::mt19937_64 random(9);
  const StepParameters truth = StepParameters::ofTimes(300.0, 8.0, 0.6, 0.12);
  Samples samples = samplesOf(truth, 10.0, 0.0, random);
  samples.y[7] = std::numeric_limits<double>::quiet_NaN();
  samples.t[9] = std::numeric_limits<double>::infinity();
  samples.t.push_back(-0.5);
  samples.y.push_back(99.0);
  std::swap(samples.t[20], samples.t[90]);
  std::swap(samples.y[20], samples.y[90]);
  const StepFit fit = fitStep(samples.t, samples.y);
  EXPECT_EQ(fit.numDropped, 3u);
  EXPECT_NEAR(fit.parameters.staticResponseCounts, 300.0, 1e-6);
  ASSERT_EQ(fit.notes.size(), 1u);
  EXPECT_NE(fit.notes[0].find("3 of"), std::string::npos);
}

TEST(StepFit, SaysWhatIsMissingWhereNothingCanBeFitted) {
  const StepFit none = fitStep({}, {});
  EXPECT_FALSE(none.converged);
  EXPECT_FALSE(none.usable());
  EXPECT_EQ(none.notes.size(), 1u);
  // What wasn't fitted is not a number, and no gain of 0.
  for (const double value : {none.parameters.staticResponseCounts,
                             none.parameters.driftCountsPerS,
                             none.parameters.timeConstantS,
                             none.parameters.damping,
                             none.rmse,
                             none.residualSd,
                             none.sd(0)})
    EXPECT_TRUE(std::isnan(value)) << value;
  const std::vector<double> two = {0.0, 0.1}, values = {0.0, 50.0};
  EXPECT_NE(fitStep(two, values).notes.at(0).find("only 2 usable samples"), std::string::npos);
  std::vector<double> t(50), zeros(50, 0.0);
  for (std::size_t i = 0; i < t.size(); ++i) t[i] = 0.03 * static_cast<double>(i);
  EXPECT_NE(fitStep(t, zeros).notes.at(0).find("no step"), std::string::npos);
  // All at one time; a ramp, which has no gain.
  EXPECT_FALSE(fitStep(zeros, t).converged);
  const StepFit ramp = fitStep(t, t);
  EXPECT_FALSE(ramp.identifiable);
  EXPECT_FALSE(ramp.notes.empty());
}

TEST(StepFit, RefusesBadOptions) {
  const std::vector<double> t = {0.0, 1.0}, one = {0.0};
  EXPECT_THROW(fitStep(t, one), std::invalid_argument);
  StepFitOptions scale;
  scale.lossScale = -1.0;
  EXPECT_THROW(fitStep(t, t, scale), std::invalid_argument);
  StepFitOptions iterations;
  iterations.maxIterations = 0;
  EXPECT_THROW(fitStep(t, t, iterations), std::invalid_argument);
  EXPECT_THROW(fitStep(t, t).sd(4), std::out_of_range);
}

}  // namespace
}  // namespace palpate::step_fit_test

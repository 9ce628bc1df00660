#include "palpate/filter/kelvin_voigt.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

#include "testing/testing.h"

namespace palpate::kelvin_voigt_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
using Square = Eigen::Matrix2d;

struct Reference {
  Square f, q;
};

// Transition and noise by one exponential of a block matrix (Van Loan 1978).
Reference vanLoan(const KelvinVoigtModel& model, double t) {
  Square a;
  a << 0.0, 1.0, -model.stiffness / model.mass, -model.viscosity / model.mass;
  Eigen::Matrix4d block = Eigen::Matrix4d::Zero();
  block.topLeftCorner<2, 2>() = -a;
  block(1, 3) = model.forceNoise / (model.mass * model.mass);
  block.bottomRightCorner<2, 2>() = a.transpose();
  const Eigen::Matrix4d scaled = block * t;
  const Eigen::Matrix4d e = scaled.exp();
  const Square f = e.bottomRightCorner<2, 2>().transpose();
  return {f, f * e.topRightCorner<2, 2>()};
}

struct Series {
  std::vector<double> timeS, values;
};

// A slow swing with noise, at uneven times.
Series swing(std::size_t n) {
  std::mt19937 random(11);
  std::normal_distribution<double> unit;
  std::uniform_real_distribution<double> interval(0.006, 0.022);
  Series series;
  double t = 1.0;
  for (std::size_t i = 0; i < n; ++i) {
    series.timeS.push_back(t);
    series.values.push_back(300.0 + 200.0 * std::sin(5.0 * t) + 10.0 * unit(random));
    t += interval(random);
  }
  return series;
}

constexpr KelvinVoigtModel kLight{.mass = 2.0,
                                  .stiffness = 800.0,
                                  .viscosity = 12.0,
                                  .forceNoise = 4e7,
                                  .measurementNoise = 90.0};

// All states at once. Unknown: y of every sample, v of all but the first (which is at rest). Least
// is sum (z - y)^2 / r + sum (x' - F x)^T Q^-1 (x' - F x).
struct Batch {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

Batch batch(const Series& series, const KelvinVoigtModel& model, std::size_t count) {
  const auto n = static_cast<Eigen::Index>(count);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (std::isfinite(series.values[at])) {
      information(2 * i, 2 * i) += 1.0 / model.measurementNoise;
      right(2 * i) += series.values[at] / model.measurementNoise;
    }
    if (i == 0) continue;
    const auto [f, q] = vanLoan(model, series.timeS[at] - series.timeS[at - 1]);
    Eigen::Matrix<double, 2, 4> difference;  // of (x before, x)
    difference << -f, Square::Identity();
    information.block<4, 4>(2 * i - 2, 2 * i - 2) +=
        difference.transpose() * q.inverse() * difference;
  }
  // The first speed is 0: its row and column go.
  Eigen::MatrixXd kept(2 * n - 1, 2 * n - 1);
  Eigen::VectorXd keptRight(2 * n - 1);
  const auto from = [](Eigen::Index i) { return i == 0 ? 0 : i + 1; };
  for (Eigen::Index i = 0; i < 2 * n - 1; ++i) {
    keptRight(i) = right(from(i));
    for (Eigen::Index j = 0; j < 2 * n - 1; ++j) kept(i, j) = information(from(i), from(j));
  }
  // Positions and speeds have very different sizes.
  const Eigen::VectorXd scale = kept.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd even = scale.asDiagonal() * kept * scale.asDiagonal();
  const Eigen::MatrixXd inverse =
      even.ldlt().solve(Eigen::MatrixXd::Identity(2 * n - 1, 2 * n - 1));
  Batch all;
  all.covariance = scale.asDiagonal() * inverse * scale.asDiagonal();
  all.mean = all.covariance * keptRight;
  return all;
}

Eigen::Index positionOf(std::size_t sample) {
  return sample == 0 ? 0 : 2 * static_cast<Eigen::Index>(sample) - 1;
}

TEST(KelvinVoigt, IsDiscretisedExactlyForEveryDamping) {
  // d = 0, 0.02, 0.999, 1, 1.001, 3, 60, without a spring, without both; intervals from 0.1 ms to a
  // second.
  for (const double damping : {0.0, 0.02, 0.9, 0.999, 1.0, 1.001, 1.2, 3.0, 60.0})
    for (const double hz : {0.05, 1.0, 8.0, 40.0})
      for (const double t : {1e-4, 0.007, 0.0134, 0.2, 1.0}) {
        const double pace = 2.0 * std::numbers::pi * hz;
        const KelvinVoigtModel model{.mass = 0.7,
                                     .stiffness = 0.7 * pace * pace,
                                     .viscosity = 0.7 * 2.0 * damping * pace,
                                     .forceNoise = 3.0};
        if (damping * pace * t > 50.0) continue;  // the reference overflows
        EXPECT_NEAR(model.naturalHz(), hz, 1e-12);
        EXPECT_NEAR(model.damping(), damping, 1e-12);
        const auto step = kelvinVoigtStep(model, t);
        const auto [f, q] = vanLoan(model, t);
        const double sizeF = 1e-11 * std::max(1.0, damping * damping);
        EXPECT_NEAR(step.fYy, f(0, 0), sizeF) << damping << " " << hz << " " << t;
        EXPECT_NEAR(step.fYv, f(0, 1), sizeF / pace);
        EXPECT_NEAR(step.fVy, f(1, 0), sizeF * pace);
        EXPECT_NEAR(step.fVv, f(1, 1), sizeF);
        // The reference loses digits where e^(-A t) is large.
        const double lost = 1e-11 * std::exp(std::min(2.0 * damping * pace * t, 100.0));
        if (lost > 1e-3) continue;
        EXPECT_NEAR(step.qYy / q(0, 0), 1.0, 1e-6 + lost) << damping << " " << hz << " " << t;
        EXPECT_NEAR(step.qYv, q(0, 1), (1e-6 + lost) * std::sqrt(q(0, 0) * q(1, 1)));
        EXPECT_NEAR(step.qVv / q(1, 1), 1.0, 1e-9 + lost);
      }
}

TEST(KelvinVoigt, FreeMassesAndLongIntervalsHaveTheirLimits) {
  // Neither spring nor damper: S/m^2 (t^3/3, t^2/2, t).
  const auto free =
      kelvinVoigtStep({.mass = 2.0, .stiffness = 0.0, .viscosity = 0.0, .forceNoise = 12.0}, 0.5);
  EXPECT_DOUBLE_EQ(free.fYv, 0.5);
  EXPECT_DOUBLE_EQ(free.fYy, 1.0);
  EXPECT_DOUBLE_EQ(free.fVy, 0.0);
  EXPECT_NEAR(free.qYy, 3.0 * 0.125 / 3.0, 1e-15);
  EXPECT_NEAR(free.qYv, 3.0 * 0.25 / 2.0, 1e-15);
  EXPECT_NEAR(free.qVv, 3.0 * 0.5, 1e-15);
  // After a long time only the noise: S / (2 E eta), 0, S / (2 m eta). Damped lightly, heavily, and
  // stiff.
  for (const auto& [e, eta] : {std::pair{50.0, 3.0}, std::pair{50.0, 700.0}, std::pair{4e9, 8e5}}) {
    const auto far =
        kelvinVoigtStep({.mass = 1.5, .stiffness = e, .viscosity = eta, .forceNoise = 6.0}, 1000.0);
    EXPECT_NEAR(far.fYy, 0.0, 1e-12);
    EXPECT_NEAR(far.fVv, 0.0, 1e-12);
    EXPECT_NEAR(far.qYy * (2.0 * e * eta) / 6.0, 1.0, 1e-9);
    EXPECT_NEAR(far.qVv * (2.0 * 1.5 * eta) / 6.0, 1.0, 1e-9);
    EXPECT_NEAR(far.qYv, 0.0, 1e-9 * std::sqrt(far.qYy * far.qVv));
  }
}

// The step response of methods, section 2, without noise: the filter's own prediction.
TEST(KelvinVoigt, FallsBackAsADampedOscillation) {
  const double pace = 10.0, d = 0.3;
  KelvinVoigtFilter filter({.mass = 1.0, .stiffness = pace * pace, .viscosity = 2.0 * d * pace});
  filter.step(100.0, 0.0);
  double t = 0.0;
  for (const double interval : {0.01, 0.02, 0.13, 0.05, 0.3}) {
    t += interval;
    const double w = pace * std::sqrt(1.0 - d * d);
    const double expected =
        100.0 * std::exp(-d * pace * t) * (std::cos(w * t) + d * pace / w * std::sin(w * t));
    EXPECT_NEAR(filter.step(kNan, interval), expected, 1e-10);
  }
}

TEST(KelvinVoigt, FilterAndSmootherAreThePosteriorOfOneDenseSolve) {
  Series series = swing(60);
  series.values[17] = series.values[18] = series.values[40] = kNan;
  for (const double viscosity : {2.0, 80.0, 900.0}) {
    KelvinVoigtModel model = kLight;
    model.viscosity = viscosity;
    const auto smoothed = kelvinVoigtSmoothed(series.timeS, series.values, model);
    const Batch all = batch(series, model, 60);
    for (std::size_t i = 0; i < 60; ++i) {
      const Eigen::Index y = positionOf(i);
      EXPECT_NEAR(smoothed.position[i], all.mean(y), 1e-5) << i;
      EXPECT_NEAR(smoothed.variance[i], all.covariance(y, y), 1e-5) << i;
      const double speed = i > 0 ? all.mean(y + 1) : 0.0;
      EXPECT_NEAR(smoothed.speed[i], speed, 1e-3) << i;
    }
    const auto filtered = kelvinVoigtFiltered(series.timeS, series.values, model);
    for (const std::size_t n : {1u, 2u, 3u, 18u, 19u, 41u, 60u})
      EXPECT_NEAR(filtered[n - 1], batch(series, model, n).mean(positionOf(n - 1)), 1e-5) << n;
  }
}

// log p(z_2 .. z_n | z_1) from the joint Gaussian: x_1 = (z_1, 0) with variance r, then z = y + v.
TEST(KelvinVoigt, LikelihoodIsThatOfTheJointGaussian) {
  const Series series = swing(30);
  const Eigen::Index n = 30;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(2 * n);
  mean(0) = series.values[0];
  covariance(0, 0) = kLight.measurementNoise;
  for (Eigen::Index i = 1; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const auto [f, q] = vanLoan(kLight, series.timeS[at] - series.timeS[at - 1]);
    mean.segment<2>(2 * i) = f * mean.segment<2>(2 * i - 2);
    covariance.block(2 * i, 0, 2, 2 * i) = f * covariance.block(2 * i - 2, 0, 2, 2 * i);
    covariance.block(0, 2 * i, 2 * i, 2) = covariance.block(2 * i, 0, 2, 2 * i).transpose();
    covariance.block<2, 2>(2 * i, 2 * i) =
        f * covariance.block<2, 2>(2 * i - 2, 2 * i - 2) * f.transpose() + q;
  }
  Eigen::VectorXd surprise(n - 1);
  Eigen::MatrixXd seen(n - 1, n - 1);
  for (Eigen::Index i = 1; i < n; ++i) {
    surprise(i - 1) = series.values[static_cast<std::size_t>(i)] - mean(2 * i);
    for (Eigen::Index j = 1; j < n; ++j)
      seen(i - 1, j - 1) = covariance(2 * i, 2 * j) + (i == j ? kLight.measurementNoise : 0.0);
  }
  const Eigen::LLT<Eigen::MatrixXd> root(seen);
  const Eigen::VectorXd whitened = root.matrixL().solve(surprise);
  double expected = -0.5 * whitened.squaredNorm() -
                    0.5 * static_cast<double>(n - 1) * std::log(2.0 * std::numbers::pi);
  for (Eigen::Index i = 0; i < n - 1; ++i) expected -= std::log(root.matrixLLT()(i, i));
  const auto smoothed = kelvinVoigtSmoothed(series.timeS, series.values, kLight);
  EXPECT_NEAR(smoothed.logLikelihood, expected, 1e-6 * std::abs(expected));
  EXPECT_EQ(smoothed.innovations, 29u);
}

TEST(KelvinVoigt, RestartsBehindAGap) {
  const Series series = swing(40);
  const std::vector<std::size_t> gaps = {0, 24};
  const auto filtered = kelvinVoigtFiltered(series.timeS, series.values, kLight, gaps);
  const auto smoothed = kelvinVoigtSmoothed(series.timeS, series.values, kLight, gaps);
  EXPECT_EQ(smoothed.innovations, 37u);
  for (const auto& [begin, end] : {std::pair{0u, 1u}, std::pair{1u, 25u}, std::pair{25u, 40u}}) {
    const auto times = std::span(series.timeS).subspan(begin, end - begin);
    const auto values = std::span(series.values).subspan(begin, end - begin);
    const auto alone = kelvinVoigtFiltered(times, values, kLight);
    const auto alsoAlone = kelvinVoigtSmoothed(times, values, kLight);
    for (std::size_t i = begin; i < end; ++i) {
      EXPECT_EQ(filtered[i], alone[i - begin]);
      EXPECT_EQ(smoothed.position[i], alsoAlone.position[i - begin]);
    }
  }
  EXPECT_THROW(
      kelvinVoigtFiltered(series.timeS, series.values, kLight, std::vector<std::size_t>{39}),
      std::invalid_argument);
}

TEST(KelvinVoigt, StreamingIsTheOfflineFilter) {
  const Series series = swing(200);
  const auto filtered = kelvinVoigtFiltered(series.timeS, series.values, kLight);
  KelvinVoigtFilter byTime(kLight), byStep(kLight);
  for (std::size_t i = 0; i < 200; ++i) {
    const double interval = i > 0 ? series.timeS[i] - series.timeS[i - 1] : 0.0;
    EXPECT_EQ(byTime.step(series.values[i], interval), filtered[i]);
    EXPECT_EQ(byStep.step(series.values[i],
                          i > 0 ? kelvinVoigtStep(kLight, interval) : KelvinVoigtStep{}),
              filtered[i]);
  }
}

TEST(KelvinVoigt, ShortAndOddSeriesAreDefined) {
  const std::vector<double> none;
  EXPECT_TRUE(kelvinVoigtFiltered(none, none, kLight).empty());
  EXPECT_TRUE(kelvinVoigtSmoothed(none, none, kLight).position.empty());
  const std::vector<double> at = {1.0, 1.1, 1.2}, late = {kNan, 8.0, 8.0}, never(3, kNan);
  EXPECT_TRUE(std::isnan(kelvinVoigtFiltered(at, late, kLight)[0]));
  const auto smoothed = kelvinVoigtSmoothed(at, late, kLight);
  EXPECT_EQ(smoothed.position[0], smoothed.position[1]);
  EXPECT_EQ(smoothed.innovations, 1u);
  EXPECT_TRUE(std::isnan(kelvinVoigtSmoothed(at, never, kLight).position[2]));
  const std::vector<double> zero(3, 0.0);
  for (const double y : kelvinVoigtSmoothed(at, zero, kLight).position) EXPECT_EQ(y, 0.0);
}

TEST(KelvinVoigt, RefusesWhatHasNoMeaning) {
  for (const KelvinVoigtModel& bad : {KelvinVoigtModel{.mass = 0.0},
                                      KelvinVoigtModel{.mass = -1.0},
                                      KelvinVoigtModel{.stiffness = -1.0},
                                      KelvinVoigtModel{.viscosity = kNan},
                                      KelvinVoigtModel{.forceNoise = 0.0},
                                      KelvinVoigtModel{.measurementNoise = 0.0}})
    EXPECT_THROW(KelvinVoigtFilter{bad}, std::invalid_argument);
  KelvinVoigtFilter filter(kLight);
  filter.step(1.0, 0.0);
  for (const double interval : {0.0, -0.1, kNan, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(filter.step(1.0, interval), std::invalid_argument);
  const std::vector<double> values(3, 1.0);
  EXPECT_THROW(kelvinVoigtSmoothed(std::vector<double>{1.0, 2.0}, values, kLight),
               std::invalid_argument);
  EXPECT_THROW(kelvinVoigtSmoothed(std::vector<double>{1.0, 2.0, 2.0}, values, kLight),
               std::invalid_argument);
  EXPECT_THROW(kelvinVoigtFiltered(std::vector<double>{1.0, kNan, 2.0}, values, kLight),
               std::invalid_argument);
}

}  // namespace
}  // namespace palpate::kelvin_voigt_test

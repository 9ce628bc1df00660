#include "palpate/filter/kalman.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <Eigen/Dense>

#include "testing/testing.h"

namespace palpate::kalman_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A walk with noise on it.
std::vector<double> walk(std::size_t n) {
  std::mt19937 random(5);
  std::normal_distribution<double> unit;
  std::vector<double> values(n);
  double state = 300.0;
  for (double& value : values) {
    state += 2.0 * unit(random);
    value = state + 5.0 * unit(random);
  }
  return values;
}

// The mean of all states given all values, by one dense solve: sum (z - x)^2 / r + sum (x_(k+1) -
// x_k)^2 / q is least.
Eigen::VectorXd batch(const std::vector<double>& z, double q, double r) {
  const auto n = static_cast<Eigen::Index>(z.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (std::isfinite(z[static_cast<std::size_t>(i)])) {
      information(i, i) += 1.0 / r;
      right(i) += z[static_cast<std::size_t>(i)] / r;
    }
    if (i + 1 == n) continue;
    information(i, i) += 1.0 / q;
    information(i + 1, i + 1) += 1.0 / q;
    information(i, i + 1) -= 1.0 / q;
    information(i + 1, i) -= 1.0 / q;
  }
  return information.ldlt().solve(right);
}

TEST(Kalman, GainGoesToTheSteadyOne) {
  KalmanFilter filter;
  for (int i = 0; i < 100; ++i) filter.step(0.0);
  EXPECT_NEAR(filter.gain(), 0.270156, 1e-6);  // methods, section 1
  EXPECT_NEAR(filter.variance(), 0.270156 * 0.5, 1e-6);
}

TEST(Kalman, StartsAtTheFirstValueAndFollowsAStep) {
  KalmanFilter filter;
  EXPECT_FALSE(filter.started());
  EXPECT_EQ(filter.step(70.0), 70.0);
  EXPECT_EQ(filter.step(70.0), 70.0);
  for (int i = 0; i < 60; ++i) filter.step(70.0);
  // Steady: what is left of a step falls by 1 - K with every sample.
  double left = 100.0;
  for (int i = 0; i < 10; ++i) {
    left *= 1.0 - 0.27015621;
    EXPECT_NEAR(filter.step(170.0), 170.0 - left, 1e-4);
  }
  // By hand from the start: P = 0.5 + 0.05, K = 0.55 / 1.05.
  filter.restart();
  filter.step(10.0);
  EXPECT_NEAR(filter.step(31.0), 10.0 + 21.0 * 0.55 / 1.05, 1e-12);
}

TEST(Kalman, WithoutProcessNoiseIsTheMeanSoFar) {
  const std::vector<double> values = walk(50);
  const auto filtered = kalmanFiltered(values, {.q = 0.0, .r = 3.0});
  double sum = 0.0;
  for (std::size_t i = 0; i < 50; ++i) {
    sum += values[i];
    EXPECT_NEAR(filtered[i], sum / static_cast<double>(i + 1), 1e-10);
  }
  for (const double value : rtsSmoothed(values, {.q = 0.0, .r = 3.0}))
    EXPECT_NEAR(value, sum / 50.0, 1e-10);
}

TEST(Kalman, IsThePosteriorOfOneDenseSolve) {
  std::vector<double> values = walk(80);
  values[20] = values[21] = values[50] = kNan;
  const auto smoothed = rtsSmoothed(values, {.q = 4.0, .r = 25.0});
  const Eigen::VectorXd expected = batch(values, 4.0, 25.0);
  for (std::size_t i = 0; i < 80; ++i)
    EXPECT_NEAR(smoothed[i], expected(static_cast<Eigen::Index>(i)), 1e-8) << i;
  // The filter: the last state given only what came until then.
  const auto filtered = kalmanFiltered(values, {.q = 4.0, .r = 25.0});
  for (const std::size_t n : {1u, 2u, 5u, 21u, 22u, 80u}) {
    const Eigen::VectorXd until =
        batch({values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n)}, 4.0, 25.0);
    EXPECT_NEAR(filtered[n - 1], until(until.size() - 1), 1e-8) << n;
  }
}

TEST(Kalman, RestartsBehindAGap) {
  const std::vector<double> values = walk(40);
  const std::vector<std::size_t> gaps = {9, 29};
  const auto filtered = kalmanFiltered(values, {}, gaps);
  const auto smoothed = rtsSmoothed(values, {}, gaps);
  for (const auto& [begin, end] : {std::pair{0, 10}, std::pair{10, 30}, std::pair{30, 40}}) {
    const std::vector<double> part(values.begin() + begin, values.begin() + end);
    const auto alone = kalmanFiltered(part), alsoAlone = rtsSmoothed(part);
    for (std::size_t i = 0; i < part.size(); ++i) {
      EXPECT_EQ(filtered[i + static_cast<std::size_t>(begin)], alone[i]);
      EXPECT_EQ(smoothed[i + static_cast<std::size_t>(begin)], alsoAlone[i]);
    }
  }
  for (const std::vector<std::size_t>& bad :
       {std::vector<std::size_t>{39}, {400}, {9, 9}, {20, 10}})
    EXPECT_THROW(kalmanFiltered(values, {}, bad), std::invalid_argument);
}

TEST(Kalman, ShortAndOddSeriesAreDefined) {
  EXPECT_TRUE(kalmanFiltered({}).empty());
  EXPECT_TRUE(rtsSmoothed({}).empty());
  EXPECT_EQ(rtsSmoothed(std::vector<double>{4.0}), std::vector<double>{4.0});
  for (const double value : rtsSmoothed(std::vector<double>(20, 8.0))) EXPECT_EQ(value, 8.0);
  const auto late = kalmanFiltered(std::vector<double>{kNan, 6.0, 6.0});
  EXPECT_TRUE(std::isnan(late[0]));
  EXPECT_EQ(late[2], 6.0);
  EXPECT_EQ(rtsSmoothed(std::vector<double>{kNan, 6.0, 6.0})[0], 6.0);
  EXPECT_TRUE(std::isnan(rtsSmoothed(std::vector<double>{kNan, kNan})[1]));
  KalmanFilter filter;
  filter.step(5.0);
  EXPECT_EQ(filter.step(std::numeric_limits<double>::infinity()), 5.0);
  EXPECT_NEAR(filter.variance(), 0.55, 1e-15);
}

TEST(Kalman, RefusesNoisesThatAreNone) {
  for (const KalmanOptions& bad : {KalmanOptions{.q = -0.1},
                                   KalmanOptions{.q = kNan},
                                   KalmanOptions{.r = 0.0},
                                   KalmanOptions{.r = -1.0},
                                   KalmanOptions{.r = kNan}}) {
    EXPECT_THROW(KalmanFilter{bad}, std::invalid_argument);
    EXPECT_THROW(rtsSmoothed(std::vector<double>{1.0}, bad), std::invalid_argument);
  }
}

}  // namespace
}  // namespace palpate::kalman_test

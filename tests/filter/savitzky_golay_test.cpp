#include "palpate/filter/savitzky_golay.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <Eigen/Dense>

#include "testing/testing.h"

namespace palpate::savitzky_golay_test {
namespace {

using Real = long double;

void expectWeights(const std::vector<double>& weights,
                   const std::vector<double>& expected,
                   double divisor) {
  ASSERT_EQ(weights.size(), expected.size());
  for (std::size_t i = 0; i < weights.size(); ++i)
    EXPECT_NEAR(weights[i], expected[i] / divisor, 1e-14) << i;
}

double largest(const std::vector<double>& weights) {
  double most = 0.0;
  for (const double w : weights) most = std::max(most, std::abs(w));
  return most;
}

// Methods, section 1, and the tables of Savitzky and Golay 1964 (with Steinier's corrections).
TEST(SavitzkyGolay, HasTheWeightsOfTheTables) {
  expectWeights(savitzkyGolayWeights(5, 2, 0, 2.0), {-3, 12, 17, 12, -3}, 35.0);
  expectWeights(savitzkyGolayWeights(5, 3, 0, 2.0), {-3, 12, 17, 12, -3}, 35.0);
  expectWeights(savitzkyGolayWeights(5, 3, 1, 2.0), {1, -8, 0, 8, -1}, 12.0);
  expectWeights(savitzkyGolayWeights(5, 4, 1, 2.0), {1, -8, 0, 8, -1}, 12.0);
  expectWeights(savitzkyGolayWeights(5, 2, 1, 2.0), {-2, -1, 0, 1, 2}, 10.0);
  expectWeights(savitzkyGolayWeights(5, 2, 2, 2.0), {2, -1, -2, -1, 2}, 7.0);
  expectWeights(savitzkyGolayWeights(7, 2, 0, 3.0), {-2, 3, 6, 7, 6, 3, -2}, 21.0);
  expectWeights(savitzkyGolayWeights(7, 4, 0, 3.0), {5, -30, 75, 131, 75, -30, 5}, 231.0);
  expectWeights(savitzkyGolayWeights(9, 2, 0, 4.0), {-21, 14, 39, 54, 59, 54, 39, 14, -21}, 231.0);
}

TEST(SavitzkyGolay, OfOrderZeroIsTheRunningMean) {
  for (const int window : {1, 2, 5, 101})
    for (const double position : {0.0, (window - 1) / 2.0, window - 1.0})
      for (const double w : savitzkyGolayWeights(window, 0, 0, position))
        EXPECT_NEAR(w, 1.0 / window, 1e-15);
}

// Straight lines, by hand: mean and slope of least squares at the ends of three and four samples.
TEST(SavitzkyGolay, AtTheNewestSampleIsTheCausalFit) {
  expectWeights(savitzkyGolayWeights(3, 1, 0, 2.0), {-1, 2, 5}, 6.0);
  expectWeights(savitzkyGolayWeights(3, 1, 0, 0.0), {5, 2, -1}, 6.0);
  expectWeights(savitzkyGolayWeights(4, 1, 0, 3.0), {-2, 1, 4, 7}, 10.0);  // an even window
  expectWeights(savitzkyGolayWeights(4, 1, 1, 3.0), {-3, -1, 1, 3}, 10.0);
}

// Whatever the window: t^p and its derivatives come out at every position.
TEST(SavitzkyGolay, PassesPolynomialsOfItsOrder) {
  for (const int window : {1, 2, 3, 4, 5, 7, 11, 20, 31, 51, 101})
    for (int order = 0; order < std::min(window, 11); ++order)
      for (int derivative = 0; derivative <= std::min(order, 3); ++derivative)
        for (const double part : {0.0, 0.13, 0.5, 1.0}) {
          const double position = part * (window - 1);
          const auto weights = savitzkyGolayWeights(window, order, derivative, position);
          for (int power = 0; power <= order; ++power) {
            // Of t = sample / window: numbers of the order of 1.
            Real value = 0.0L;
            for (int i = 0; i < window; ++i)
              value += static_cast<Real>(weights[static_cast<std::size_t>(i)]) *
                       std::pow(static_cast<Real>(i) / window, static_cast<Real>(power));
            Real expected = power < derivative ? 0.0L
                                               : std::pow(static_cast<Real>(position) / window,
                                                          static_cast<Real>(power - derivative));
            for (int d = 0; d < derivative; ++d)
              expected *= static_cast<Real>(power - d) / static_cast<Real>(window);
            EXPECT_NEAR(static_cast<double>(value),
                        static_cast<double>(expected),
                        1e-13 * std::max(1.0, largest(weights)))
                << window << " order " << order << " derivative " << derivative << " at "
                << position << " t^" << power;
          }
        }
}

// Another way: least squares of Legendre polynomials by Householder QR, in long double.
TEST(SavitzkyGolay, IsTheLeastSquaresFitOfLargeWindowsToo) {
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  for (const int window : {21, 64, 101})
    for (const int order : {2, 5, 10, 15, 20}) {
      const auto legendre = [&](Real x) {
        Eigen::Matrix<Real, 1, Eigen::Dynamic> row(order + 1);
        row(0) = 1.0L;
        if (order > 0) row(1) = x;
        for (int k = 1; k < order; ++k)
          row(k + 1) = ((2 * k + 1) * x * row(k) - k * row(k - 1)) / static_cast<Real>(k + 1);
        return row;
      };
      const auto placed = [&](Real i) { return 2.0L * i / static_cast<Real>(window - 1) - 1.0L; };
      Matrix design(window, order + 1);
      for (int i = 0; i < window; ++i) design.row(i) = legendre(placed(static_cast<Real>(i)));
      const Matrix fit = design.householderQr().solve(
          Matrix::Identity(window, window));  // coefficients per sample
      for (const double position : {0.0, 3.3, (window - 1) / 2.0, window - 1.0}) {
        const Matrix expected = legendre(placed(static_cast<Real>(position))) * fit;
        const auto weights = savitzkyGolayWeights(window, order, 0, position);
        for (int i = 0; i < window; ++i)
          EXPECT_NEAR(weights[static_cast<std::size_t>(i)],
                      static_cast<double>(expected(0, i)),
                      1e-12 * largest(weights))
              << window << " order " << order << " at " << position;
      }
    }
}

// As many coefficients as samples: at a sample the polynomial is the sample.
TEST(SavitzkyGolay, OfFullOrderIsTheSampleItself) {
  for (const int window : {1, 2, 3, 8, 21, 50, 101})
    for (const int at : {0, window / 3, window - 1}) {
      const auto weights = savitzkyGolayWeights(window, window - 1, 0, at);
      for (int i = 0; i < window; ++i)
        EXPECT_NEAR(weights[static_cast<std::size_t>(i)], i == at ? 1.0 : 0.0, 1e-9)
            << window << " at " << at;
    }
}

TEST(SavitzkyGolay, IsMirroredWhereThePositionIs) {
  for (const int derivative : {0, 1, 2}) {
    const auto early = savitzkyGolayWeights(31, 4, derivative, 2.5);
    const auto late = savitzkyGolayWeights(31, 4, derivative, 27.5);
    for (std::size_t i = 0; i < 31; ++i)
      EXPECT_NEAR(late[30 - i], derivative == 1 ? -early[i] : early[i], 1e-14);
  }
}

TEST(SavitzkyGolay, RefusesWhatHasNoMeaning) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(savitzkyGolayWeights(0, 0, 0, 0.0), std::invalid_argument);
  EXPECT_THROW(savitzkyGolayWeights(-5, 0, 0, 0.0), std::invalid_argument);
  EXPECT_THROW(savitzkyGolayWeights(102, 2, 0, 0.0), std::invalid_argument);
  EXPECT_THROW(savitzkyGolayWeights(103, 2, 0, 0.0), std::invalid_argument);
  EXPECT_THROW(savitzkyGolayWeights(5, 5, 0, 2.0), std::invalid_argument);
  EXPECT_THROW(savitzkyGolayWeights(5, -1, 0, 2.0), std::invalid_argument);
  EXPECT_THROW(savitzkyGolayWeights(5, 2, 3, 2.0), std::invalid_argument);
  EXPECT_THROW(savitzkyGolayWeights(5, 2, -1, 2.0), std::invalid_argument);
  for (const double position : {-0.1, 4.1, nan})
    EXPECT_THROW(savitzkyGolayWeights(5, 2, 0, position), std::invalid_argument);
  try {
    savitzkyGolayWeights(5, 7, 0, 2.0);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "savitzky-golay: order must be 0..4 (below the window), is 7");
  }
}

}  // namespace
}  // namespace palpate::savitzky_golay_test

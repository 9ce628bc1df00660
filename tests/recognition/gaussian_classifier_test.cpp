#include "palpate/recognition/gaussian_classifier.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "recognition/golden_samples.h"
#include "testing/testing.h"

namespace palpate::gaussian_classifier_test {
namespace {

using testing::clouds;

// Class 0: -1, 1 (variance 2), class 1: 8, 12 (variance 8); pooled (2 + 8) / 2 = 5.
const Eigen::MatrixXd kLine = (Eigen::MatrixXd(4, 1) << -1, 1, 8, 12).finished();
const std::vector<int> kSides = {0, 0, 1, 1};

TEST(GaussianClassifier, MixesClassAndPooledVariance) {
  const double ridge = 1e-9;
  const auto fitted =
      GaussianClassifier::of(kLine, kSides, 2, {.pooledFraction = 0.25, .ridge = ridge});
  const double v0 = 0.75 * 2 + 0.25 * 5, v1 = 0.75 * 8 + 0.25 * 5;
  Eigen::MatrixXd x(1, 1);
  x << 3.0;
  const Eigen::MatrixXd density = fitted.logDensity(x);
  EXPECT_NEAR(density(0, 0), -0.5 * (9.0 / v0 + std::log(v0)), 1e-7);
  EXPECT_NEAR(density(0, 1), -0.5 * (49.0 / v1 + std::log(v1)), 1e-7);
  EXPECT_NEAR(fitted.nearestSquaredDistance(x)[0], 9.0 / v0, 1e-7);
}

TEST(GaussianClassifier, AddsWhatOtherDaysAdd) {
  const auto fitted = GaussianClassifier::of(
      kLine, kSides, 2, {.pooledFraction = 1.0, .extraVariance = 0.5, .ridge = 1e-9});
  Eigen::MatrixXd x(1, 1);
  x << 3.0;
  EXPECT_NEAR(fitted.nearestSquaredDistance(x)[0], 9.0 / (5.0 * 1.5), 1e-7);
}

// With a common covariance matrix the border of two classes is the plane of linear discriminant
// analysis, halfway between the means.
TEST(GaussianClassifier, OneCovarianceIsTheLinearRule) {
  const auto fitted = GaussianClassifier::of(kLine, kSides, 2, {.pooledFraction = 1.0});
  Eigen::MatrixXd x(2, 1);
  x << 4.999, 5.001;
  const Eigen::MatrixXd density = fitted.logDensity(x);
  EXPECT_GT(density(0, 0), density(0, 1));
  EXPECT_LT(density(1, 0), density(1, 1));
}

TEST(GaussianClassifier, WeakensCorrelations) {
  SampleSet samples = clouds(2, 40, 2, 0.0, 4);
  samples.x.col(1) = samples.x.col(0) + 0.1 * samples.x.col(1);  // nearly one line
  Eigen::MatrixXd off(1, 2);
  off << 3.0, -3.0;
  const auto whole = GaussianClassifier::of(samples.x, samples.y, 2, {.correlationScale = 1.0});
  const auto none = GaussianClassifier::of(samples.x, samples.y, 2, {.correlationScale = 0.0});
  EXPECT_GT(whole.nearestSquaredDistance(off)[0], 20.0 * none.nearestSquaredDistance(off)[0]);
}

TEST(GaussianClassifier, AClassWithOneSampleTakesThePooledCovariance) {
  Eigen::MatrixXd x(4, 1);
  x << -1, 1, 50, 8;
  const auto fitted =
      GaussianClassifier::of(x, {0, 0, 1, 3}, 5, {.pooledFraction = 0.0, .ridge = 1e-9});
  Eigen::MatrixXd at(1, 1);
  at << 52.0;
  EXPECT_NEAR(fitted.nearestSquaredDistance(at)[0], 4.0 / 2.0, 1e-7);
  EXPECT_EQ(fitted.logDensity(at)(0, 2), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(fitted.logDensity(at)(0, 4), -std::numeric_limits<double>::infinity());
}

TEST(GaussianClassifier, RefusesBrokenContracts) {
  EXPECT_THROW(GaussianClassifier::of(kLine, kSides, 1), std::invalid_argument);
  EXPECT_THROW(GaussianClassifier::of(kLine, {0, 1, 2, 3}, 4), std::invalid_argument);
  EXPECT_THROW(GaussianClassifier::of(kLine, kSides, 2, {.pooledFraction = 1.1}),
               std::invalid_argument);
  EXPECT_THROW(GaussianClassifier::of(kLine, kSides, 2, {.ridge = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::gaussian_classifier_test

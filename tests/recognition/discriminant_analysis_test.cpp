#include "palpate/recognition/discriminant_analysis.h"

#include <algorithm>
#include <stdexcept>

#include "recognition/golden_samples.h"
#include "testing/testing.h"

namespace palpate::discriminant_analysis_test {
namespace {

using testing::clouds;

// Two classes, four samples each, spread (+-a, 0), (0, +-b) about (-d, 0) and (d, 0).
struct Cross {
  Eigen::MatrixXd x{8, 2};
  std::vector<int> y{0, 0, 0, 0, 1, 1, 1, 1};
  Cross(double a, double b, const Eigen::Vector2d& d) {
    for (int c = 0; c < 2; ++c) {
      const Eigen::Vector2d centre = (c == 0 ? -1.0 : 1.0) * d;
      x.row(4 * c) = centre + Eigen::Vector2d(a, 0);
      x.row(4 * c + 1) = centre - Eigen::Vector2d(a, 0);
      x.row(4 * c + 2) = centre + Eigen::Vector2d(0, b);
      x.row(4 * c + 3) = centre - Eigen::Vector2d(0, b);
    }
  }
};

// Two classes: w is along S_w^-1 (m_1 - m_0) (Fisher). S_w = diag(4 a^2, 4 b^2) / 6, the means lie
// 2 d apart, S_b = 8 d d' (1 degree of freedom), lambda = 8 d' S_w^-1 d.
TEST(DiscriminantAnalysis, FindsFishersDirectionOfTwoClasses) {
  const double a = 0.5, b = 2.0;
  const Eigen::Vector2d d(3.0, 1.0);
  const Cross cross(a, b, d);
  const auto fitted = DiscriminantAnalysis::of(cross.x, cross.y, {.ridge = 1e-6});
  const Eigen::Vector2d within(4 * a * a / 6.0, 4 * b * b / 6.0);
  const Eigen::Vector2d fisher = d.cwiseQuotient(within);
  ASSERT_EQ(fitted.directions.cols(), 1) << "two classes have one direction";
  const Eigen::Vector2d w = fitted.directions.col(0);
  EXPECT_NEAR(w[1] / w[0], fisher[1] / fisher[0], 1e-4);
  EXPECT_NEAR(fitted.separation[0], 8.0 * d.dot(fisher), 1e-3 * fitted.separation[0]);
  EXPECT_NEAR(w.dot(within.asDiagonal() * w), 1.0, 1e-4) << "w' S_w w = 1";
  EXPECT_GT(w[0], 0.0) << "its largest entry is positive";
  const Eigen::MatrixXd z = fitted.apply(cross.x);
  EXPECT_NEAR(z.col(0).sum(), 0.0, 1e-9);
  EXPECT_NEAR(fitted.apply(cross.x.row(0))(0, 0), z(0, 0), 1e-12);
}

TEST(DiscriminantAnalysis, SolvesTheGeneralisedEigenproblem) {
  const SampleSet samples = clouds(6, 9, 5, 4.0, 7);
  const auto fitted = DiscriminantAnalysis::of(samples.x, samples.y);
  ASSERT_EQ(fitted.directions.cols(), 5);
  const WithinScatter within = withinScatter(samples.x, samples.y);
  const Eigen::VectorXd mean = samples.x.colwise().mean();
  Eigen::MatrixXd between = Eigen::MatrixXd::Zero(5, 5);
  for (int c = 0; c < 6; ++c) {
    const Eigen::VectorXd away = within.means.row(c).transpose() - mean;
    between += 9.0 / 5.0 * away * away.transpose();
  }
  for (Eigen::Index k = 0; k < 5; ++k) {
    const Eigen::VectorXd w = fitted.directions.col(k);
    EXPECT_LT((between * w - fitted.separation[k] * within.covariance * w).norm(),
              1e-4 * (between * w).norm());
    EXPECT_LE(fitted.separation[k], fitted.separation[std::max<Eigen::Index>(k - 1, 0)]);
  }
}

TEST(DiscriminantAnalysis, KeepsToTheComponentsThatThereAre) {
  const SampleSet samples = clouds(4, 5, 6, 4.0, 7);
  EXPECT_EQ(DiscriminantAnalysis::of(samples.x, samples.y, {.components = 2}).directions.cols(), 2);
  EXPECT_EQ(DiscriminantAnalysis::of(samples.x, samples.y, {.components = 50}).directions.cols(),
            3);
}

TEST(DiscriminantAnalysis, BearsFeaturesThatAreMultiplesOfOthers) {
  SampleSet samples = clouds(3, 6, 3, 5.0, 3);
  samples.x.col(2) = 2.0 * samples.x.col(0);
  const auto fitted = DiscriminantAnalysis::of(samples.x, samples.y);
  EXPECT_TRUE(fitted.directions.allFinite());
  EXPECT_GT(fitted.separation[0], 10.0);
}

// The formula computed by its definition: |x x' - S|^2 for each sample.
TEST(DiscriminantAnalysis, ShrinkageIsLedoitAndWolfs) {
  Eigen::MatrixXd x = clouds(1, 12, 4, 0.0, 5).x;
  x.rowwise() -= x.colwise().mean().eval();
  const double n = 12, d = 4;
  const Eigen::MatrixXd s = x.transpose() * x / n;
  const double mu = s.trace() / d;
  double spread = 0.0;
  for (Eigen::Index i = 0; i < 12; ++i)
    spread += (x.row(i).transpose() * x.row(i) - s).squaredNorm() / d;
  const double delta = (s - mu * Eigen::MatrixXd::Identity(4, 4)).squaredNorm() / d;
  EXPECT_NEAR(ledoitWolfShrinkage(x), std::min(spread / n / n, delta) / delta, 1e-12);
  EXPECT_EQ(ledoitWolfShrinkage(Eigen::MatrixXd::Zero(5, 3)), 1.0);
  const SampleSet samples = clouds(3, 6, 4, 5.0, 3);
  const auto fitted = DiscriminantAnalysis::of(samples.x, samples.y, {.shrinkage = std::nullopt});
  EXPECT_DOUBLE_EQ(fitted.shrinkage,
                   ledoitWolfShrinkage(withinScatter(samples.x, samples.y).residuals));
}

TEST(DiscriminantAnalysis, WeighsTheFeaturesThatTellClassesApart) {
  SampleSet samples = clouds(3, 30, 4, 0.0, 9);
  for (std::size_t i = 0; i < samples.y.size(); ++i)
    samples.x(static_cast<Eigen::Index>(i), 2) += 20.0 * samples.y[i];
  const Eigen::VectorXd weights = DiscriminantAnalysis::of(samples.x, samples.y).featureWeights();
  EXPECT_NEAR(weights.sum(), 1.0, 1e-12);
  Eigen::Index most = 0;
  weights.maxCoeff(&most);
  EXPECT_EQ(most, 2);
}

TEST(DiscriminantAnalysis, RefusesWhatHasNoScatter) {
  const SampleSet samples = clouds(3, 1, 2, 5.0, 3);
  EXPECT_THROW(DiscriminantAnalysis::of(samples.x, samples.y), std::invalid_argument);
  EXPECT_THROW(DiscriminantAnalysis::of(samples.x, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(DiscriminantAnalysis::of(samples.x, {0, 0}), std::invalid_argument);
  EXPECT_THROW(DiscriminantAnalysis::of(samples.x, {0, 0, -1}), std::invalid_argument);
  EXPECT_THROW(DiscriminantAnalysis::of(samples.x, {0, 0, 1}, {.ridge = 0.0}),
               std::invalid_argument);
  EXPECT_THROW(DiscriminantAnalysis::of(samples.x, {0, 0, 1}, {.shrinkage = 1.5}),
               std::invalid_argument);
}

}  // namespace
}  // namespace palpate::discriminant_analysis_test

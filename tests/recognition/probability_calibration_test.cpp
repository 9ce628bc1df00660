#include "palpate/recognition/probability_calibration.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "testing/testing.h"

namespace palpate::probability_calibration_test {
namespace {

// Labels drawn from a known sigmoid.
TEST(ProbabilityCalibration, FindsTheSigmoidThatMadeTheLabels) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> decisions;
  std::vector<bool> first;
  for (int i = 0; i < 20000; ++i) {
    decisions.push_back(6.0 * uniform(generator) - 3.0);
    first.push_back(uniform(generator) < 1.0 / (1.0 + std::exp(-1.7 * decisions.back() + 0.6)));
  }
  const Sigmoid fitted = fitSigmoid(decisions, first);
  EXPECT_NEAR(fitted.a, -1.7, 0.08);
  EXPECT_NEAR(fitted.b, 0.6, 0.06);
  EXPECT_NEAR(fitted.at(0.0), 1.0 / (1.0 + std::exp(0.6)), 0.015);
}

// Platt's targets keep the probabilities of separable decisions below 1: (n + 1) / (n + 2) for n
// samples.
TEST(ProbabilityCalibration, SeparableDecisionsStayShortOfCertainty) {
  const Sigmoid fitted = fitSigmoid({-2, -2, -2, 2, 2, 2}, {false, false, false, true, true, true});
  EXPECT_NEAR(fitted.at(2.0), 4.0 / 5.0, 1e-3);
  EXPECT_NEAR(fitted.at(-2.0), 1.0 / 5.0, 1e-3);
  EXPECT_GE(fitted.at(1e6), 0.0);
  EXPECT_LE(fitted.at(1e6), 1.0);
  EXPECT_GE(fitted.at(-1e6), 0.0);
}

// If P(i | i or j) = p_i / (p_i + p_j) for some p, the result is p.
TEST(ProbabilityCalibration, CouplingGivesBackWhatThePairsCameFrom) {
  const Eigen::Vector4d truth(0.5, 0.3, 0.15, 0.05);
  Eigen::MatrixXd r(4, 4);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) r(i, j) = truth[i] / (truth[i] + truth[j]);
  const Eigen::VectorXd p = coupleProbabilities(r);
  EXPECT_NEAR(p.sum(), 1.0, 1e-12);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(p[i], truth[i], 0.005);
  EXPECT_THROW(coupleProbabilities(Eigen::MatrixXd(2, 3)), std::invalid_argument);
}

TEST(ProbabilityCalibration, CouplingBearsCertainPairs) {
  Eigen::MatrixXd r(3, 3);
  r << 0, 1, 1, 0, 0, 0.5, 0, 0.5, 0;
  const Eigen::VectorXd p = coupleProbabilities(r);
  EXPECT_TRUE(p.allFinite());
  EXPECT_GT(p[0], 0.98);
}

TEST(ProbabilityCalibration, SoftmaxSumsToOneWhateverTheSize) {
  Eigen::MatrixXd scores(2, 3);
  scores << -1e5, -1e5 + std::log(3.0), -std::numeric_limits<double>::infinity(), 0, 0, 0;
  const Eigen::MatrixXd p = softmaxRows(scores);
  EXPECT_NEAR(p(0, 1), 0.75, 1e-9);
  EXPECT_EQ(p(0, 2), 0.0);
  EXPECT_NEAR(p(1, 0), 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(softmaxRows(scores, 2.0)(0, 1), 0.9, 1e-9);
}

// Labels drawn from softmax(t s): t is estimated.
TEST(ProbabilityCalibration, FindsTheExponentThatMadeTheLabels) {
  std::mt19937_64 generator(8);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  for (const double truth : {0.25, 3.0}) {
    Eigen::MatrixXd scores(4000, 3);
    std::vector<int> y;
    for (Eigen::Index i = 0; i < scores.rows(); ++i) {
      for (Eigen::Index c = 0; c < 3; ++c) scores(i, c) = normal(generator);
      const Eigen::MatrixXd p = softmaxRows(scores.row(i), truth);
      const double drawn = uniform(generator);
      y.push_back(drawn < p(0, 0) ? 0 : drawn < p(0, 0) + p(0, 1) ? 1 : 2);
    }
    EXPECT_NEAR(fitExponent(scores, y), truth, 0.08 * truth + 0.04);
  }
  EXPECT_EQ(fitExponent(Eigen::MatrixXd(0, 3), {}), 1.0);
  EXPECT_THROW(fitExponent(Eigen::MatrixXd(1, 3), {}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::probability_calibration_test

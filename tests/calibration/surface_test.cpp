#include "palpate/calibration/surface.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>

#include "palpate/core/number_text.h"

#include "testing/testing.h"

namespace palpate::surface_test {
namespace {

// K, m, T (nearest motor, study) and P of the 24 shared steps.
struct Step {
  double k, m, nearest, study, kpa;
};
std::vector<Step> realSteps(const std::filesystem::path& golden) {
  std::ifstream in(golden / "pressure_calibration.csv");
  std::vector<Step> steps;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<double> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');)
      cells.push_back(parseDouble(cell).value_or(0.0));
    steps.push_back({cells[4], cells[5], cells[9], cells[8], cells[3]});
  }
  return steps;
}

void expectCoefficients(const Surface& surface,
                        const std::vector<double>& c,
                        double rmse,
                        double loo) {
  ASSERT_TRUE(surface.valid);
  for (std::size_t k = 0; k < c.size(); ++k)
    EXPECT_NEAR(surface.c[static_cast<Eigen::Index>(k)] / c[k], 1.0, 2e-6) << k;
  EXPECT_NEAR(surface.rmse, rmse, 1e-5);
  EXPECT_NEAR(surface.looRmse, loo, 1e-5);
}

// The same 24 points by NumPy (QR in double precision, leave-one-out by the hat matrix).
TEST(Surface, AgreesWithNumPyOnTheRealSteps) {
  const auto golden = testing::goldenFolder();
  PALPATE_NEED(golden);
  std::vector<SurfacePoint> gain, drift;
  for (const Step& s : realSteps(*golden)) {
    gain.push_back({s.k, s.study, s.kpa});
    drift.push_back({s.m, s.study, s.kpa});
  }
  ASSERT_EQ(gain.size(), 24u);
  expectCoefficients(fitSurface(gain, surfaceTerms(1), SurfaceSelection::kAllTerms),
                     {32.7273191, -0.628729874, 0.105928423, -0.000217258496},
                     2.419825,
                     3.059324);
  expectCoefficients(fitSurface(drift, surfaceTerms(2), SurfaceSelection::kAllTerms),
                     {150.679584,
                      -6.04419606,
                      0.0646825815,
                      -36.6968826,
                      1.5622683,
                      -0.0153506285,
                      3.11705331,
                      -0.120875955,
                      0.00116088783},
                     3.649416,
                     5.918544);
}

// As the study found: the term K T brings nothing. Its plane over 54 steps: 31.90, -.625, .0978,
// -.0000386.
TEST(Surface, LeavesOutTheTermThatBringsNothing) {
  const auto golden = testing::goldenFolder();
  PALPATE_NEED(golden);
  std::vector<SurfacePoint> points;
  for (const Step& s : realSteps(*golden)) points.push_back({s.k, s.nearest, s.kpa});
  const Surface surface = fitSurface(points, surfaceTerms(1), SurfaceSelection::kLeaveOneOut);
  EXPECT_EQ(surface.numTerms, 3u);
  EXPECT_EQ(surface.c[3], 0.0);
  EXPECT_NEAR(surface.c[0], 38.1802403, 1e-5);
  EXPECT_NEAR(surface.c[1], -0.876049832, 1e-7);
  EXPECT_NEAR(surface.c[2], 0.0964252728, 1e-8);
  EXPECT_NEAR(surface.looRmse, 2.834775, 1e-5);
}

std::vector<SurfacePoint> plane(double noise, std::uint64_t seed, int n = 40) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> x(50.0, 800.0), t(26.0, 45.0);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < n; ++i) {
    SurfacePoint p{x(random), t(random), 0.0};
    p.z = 30.0 - 0.6 * p.t + 0.1 * p.x + noise * normal(random);
    points.push_back(p);
  }
  return points;
}

TEST(Surface, ItsBandHoldsNewMeasurements) {
  int inside = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Surface surface =
        fitSurface(plane(2.0, seed, 20), surfaceTerms(1), SurfaceSelection::kAllTerms);
    for (const SurfacePoint& p : plane(2.0, seed + 1000, 10)) {
      const SurfaceEstimate estimate = surface.at(p.x, p.t);
      // t(16 dof) at 97.5 %
      inside += std::abs(estimate.value - p.z) <= 2.12 * estimate.sd ? 1 : 0;
      ++all;
    }
  }
  EXPECT_NEAR(static_cast<double>(inside) / all, 0.95, 0.015);
}

TEST(Surface, LeaveOneOutIsWhatRefittingGives) {
  const std::vector<SurfacePoint> points = plane(3.0, 5, 12);
  const Surface whole = fitSurface(points, surfaceTerms(1), SurfaceSelection::kAllTerms);
  double squares = 0.0;
  for (std::size_t left = 0; left < points.size(); ++left) {
    std::vector<SurfacePoint> others = points;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left));
    const Surface without = fitSurface(others, surfaceTerms(1), SurfaceSelection::kAllTerms);
    squares += std::pow(without.at(points[left].x, points[left].t).value - points[left].z, 2);
  }
  EXPECT_NEAR(whole.looRmse, std::sqrt(squares / 12.0), 1e-9);
}

TEST(Surface, DerivativesAgreeWithDifferences) {
  const Surface s = fitSurface(plane(2.0, 3), surfaceTerms(2), SurfaceSelection::kAllTerms);
  EXPECT_NEAR(
      s.at(300.0, 35.0).byX, (s.at(300.01, 35.0).value - s.at(299.99, 35.0).value) / 0.02, 1e-6);
  EXPECT_NEAR(
      s.at(300.0, 35.0).byT, (s.at(300.0, 35.001).value - s.at(300.0, 34.999).value) / 0.002, 1e-6);
}

TEST(Surface, KnowsWhereItWasMeasured) {
  const std::vector<SurfacePoint> square = {
      {100, 30, 1}, {500, 30, 5}, {100, 40, 2}, {500, 40, 6}, {300, 35, 3}};
  const Surface s = fitSurface(square, surfaceTerms(1), SurfaceSelection::kAllTerms);
  EXPECT_EQ(s.hull.size(), 4u);
  EXPECT_TRUE(s.at(300.0, 35.0).inRange);
  EXPECT_TRUE(s.at(100.0, 30.0).inRange);
  EXPECT_TRUE(s.at(505.0, 35.0).inRange) << "5 % about the middle";
  EXPECT_FALSE(s.at(530.0, 35.0).inRange);
  EXPECT_FALSE(s.at(300.0, 42.0).inRange);
  EXPECT_FALSE(s.at(0.0, 0.0).inRange);
  EXPECT_TRUE(s.at(20.0, 35.0).tooLight);
  EXPECT_FALSE(s.at(300.0, 35.0).tooLight) << "in range";
  EXPECT_FALSE(s.at(530.0, 35.0).tooLight) << "too strong";
  EXPECT_FALSE(s.at(20.0, 42.0).tooLight) << "nothing was measured at this temperature";
}

TEST(Surface, ASlantingHullKnowsItsLightEnd) {
  // K begins higher where it is warmer, as in the study's calibration.
  const std::vector<SurfacePoint> slanting = {
      {50, 26, 1}, {550, 28, 5}, {800, 45, 6}, {130, 42, 2}, {300, 35, 3}};
  const Surface s = fitSurface(slanting, surfaceTerms(1), SurfaceSelection::kAllTerms);
  EXPECT_TRUE(s.at(60.0, 36.0).tooLight);
  EXPECT_FALSE(s.at(760.0, 30.0).tooLight) << "too strong at this temperature";
  EXPECT_FALSE(s.at(760.0, 30.0).inRange);
}

TEST(Surface, OneTemperatureGivesALineInGain) {
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 8; ++i) points.push_back({100.0 * i, 30.0, 5.0 + 10.0 * i + (i % 2)});
  const Surface s = fitSurface(points, surfaceTerms(1), SurfaceSelection::kLeaveOneOut);
  ASSERT_TRUE(s.valid);
  EXPECT_EQ(s.numTerms, 2u);
  EXPECT_TRUE(s.at(300.0, 31.0).inRange);
  EXPECT_FALSE(s.at(300.0, 40.0).inRange);
  EXPECT_TRUE(s.at(-60.0, 31.0).tooLight);
  EXPECT_FALSE(s.at(-60.0, 40.0).tooLight);
  const Surface all = fitSurface(points, surfaceTerms(1), SurfaceSelection::kAllTerms);
  EXPECT_FALSE(all.valid) << "four terms aren't determined";
  EXPECT_TRUE(std::isnan(all.at(300.0, 30.0).value));
  EXPECT_FALSE(all.notes.empty());
}

TEST(Surface, SaysWhatTooFewOrCollinearPointsAllow) {
  EXPECT_FALSE(fitSurface({}, surfaceTerms(1), SurfaceSelection::kLeaveOneOut).valid);
  const std::vector<SurfacePoint> two = {{100, 30, 10}, {500, 40, 50}};
  const Surface fromTwo = fitSurface(two, surfaceTerms(1), SurfaceSelection::kAllTerms);
  EXPECT_FALSE(fromTwo.valid);
  EXPECT_NE(fromTwo.notes.at(0).find("too few"), std::string::npos);
  std::vector<SurfacePoint> line;  // warmer with every weight
  for (int i = 0; i < 10; ++i)
    line.push_back({100.0 + 50.0 * i, 25.0 + 2.0 * i, 10.0 * i + 0.1 * (i % 3)});
  const Surface fromLine = fitSurface(line, {{0, 0}, {1, 0}, {0, 1}}, SurfaceSelection::kAllTerms);
  EXPECT_FALSE(fromLine.valid);
  EXPECT_NE(fromLine.notes.at(0).find("line"), std::string::npos);
  EXPECT_TRUE(fitSurface(line, {{0, 0}, {1, 0}, {0, 1}}, SurfaceSelection::kLeaveOneOut).valid);
  std::vector<SurfacePoint> broken = plane(1.0, 9);
  broken.push_back({std::numeric_limits<double>::quiet_NaN(), 30.0, 1.0});
  const Surface rest = fitSurface(broken, surfaceTerms(1), SurfaceSelection::kAllTerms);
  EXPECT_TRUE(rest.valid);
  EXPECT_EQ(rest.numPoints, 40u);
  EXPECT_NE(rest.notes.at(0).find("not numbers"), std::string::npos);
  EXPECT_THROW(fitSurface(two, {}, SurfaceSelection::kAllTerms), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::surface_test

#include "palpate/slip/surface_information.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace palpate::surface_information_test {
namespace {

constexpr int kRows = 16;
constexpr int kColumns = 15;
using Weights = std::array<float, 4>;

// Weights of the cubic B-spline halfway between two knots and at a knot.
constexpr Weights kBetween{1.0F / 48, 23.0F / 48, 23.0F / 48, 1.0F / 48};
constexpr Weights kAtKnot{1.0F / 6, 4.0F / 6, 1.0F / 6, 0.0F};

struct Reading {
  int row, column;
  bool betweenX, betweenY;
  float gain, counts, variance;
};

std::vector<Reading> someReadings() {
  std::vector<Reading> readings;
  for (int y = 3; y <= 9; y += 2)
    for (int x = 3; x <= 7; x += 2)
      readings.push_back({y,
                          x,
                          (x + y) % 4 == 0,
                          x % 4 == 1,
                          1.0F + 0.05F * static_cast<float>(x),
                          100.0F * std::sin(0.7F * static_cast<float>(x)) + 300.0F,
                          25.0F + static_cast<float>(y)});
  return readings;
}

// The same problem as one dense system; the operator is written out by itself.
Eigen::VectorXd solvedDensely(const std::vector<Reading>& readings,
                              double sd,
                              double kept,
                              const std::vector<float>& boundary) {
  constexpr int kSize = kRows * kColumns;
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(kSize, kSize);
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; ++x) {
      laplacian(y * kColumns + x, y * kColumns + x) = 16.0;
      if (y > 0) laplacian(y * kColumns + x, (y - 1) * kColumns + x) = -4.0;
      if (y + 1 < kRows) laplacian(y * kColumns + x, (y + 1) * kColumns + x) = -4.0;
      if (x > 0) laplacian(y * kColumns + x, y * kColumns + x - 1) = -4.0;
      if (x + 1 < kColumns) laplacian(y * kColumns + x, y * kColumns + x + 1) = -4.0;
    }
  Eigen::MatrixXd information = 0.25 / (sd * sd) *
                                (0.01 * Eigen::MatrixXd::Identity(kSize, kSize) + 0.4 * laplacian +
                                 0.24 * laplacian * laplacian * laplacian);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(kSize);
  for (const Reading& one : readings) {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(kSize);
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
        weights((one.row + j) * kColumns + one.column + i) =
            static_cast<double>((one.betweenX ? kBetween : kAtKnot)[static_cast<std::size_t>(i)] *
                                (one.betweenY ? kBetween : kAtKnot)[static_cast<std::size_t>(j)]);
    weights *= static_cast<double>(one.gain);
    information += kept / static_cast<double>(one.variance) * weights * weights.transpose();
    right += kept * static_cast<double>(one.counts / one.variance) * weights;
  }
  // Only the places of readings, rows 3..12 and columns 3..10, are free.
  std::vector<Eigen::Index> free;
  Eigen::VectorXd all(kSize);
  for (int i = 0; i < kSize; ++i) {
    all(i) = static_cast<double>(boundary[static_cast<std::size_t>(i)]);
    const int y = i / kColumns;
    const int x = i % kColumns;
    if (y < 3 || y > 12 || x < 3 || x > 10) continue;
    free.push_back(i);
    all(i) = 0.0;
  }
  right -= information * all;
  const Eigen::VectorXd part = information(free, free).ldlt().solve(right(free));
  all(free) = part;
  return all;
}

void addAll(SurfaceInformation& surface,
            const std::vector<Reading>& readings,
            const std::vector<float>& coefficients) {
  for (const Reading& one : readings)
    surface.add(coefficients.data(),
                one.row * kColumns + one.column,
                (one.betweenX ? kBetween : kAtKnot).data(),
                (one.betweenY ? kBetween : kAtKnot).data(),
                one.gain,
                one.counts,
                one.variance);
}

void expectNear(const std::vector<float>& found, const Eigen::VectorXd& expected) {
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(static_cast<double>(found[i]), expected(static_cast<Eigen::Index>(i)), 0.5) << i;
}

TEST(SurfaceInformation, FindsTheMostProbableCoefficients) {
  const std::vector<Reading> readings = someReadings();
  std::vector<float> coefficients(kRows * kColumns, 20.0F);
  const Eigen::VectorXd expected = solvedDensely(readings, 400.0, 1.0, coefficients);
  SurfaceInformation surface(kRows, kColumns);
  surface.begin(400.0);
  addAll(surface, readings, coefficients);
  surface.solve(coefficients.data(), 300);
  expectNear(coefficients, expected);
}

// A few iterations at a time come to the same result, and readings may come in between.
TEST(SurfaceInformation, GoesOnFromWhatItFound) {
  std::vector<Reading> readings = someReadings();
  std::vector<float> coefficients(kRows * kColumns, 20.0F);
  SurfaceInformation surface(kRows, kColumns);
  surface.begin(400.0);
  addAll(surface, readings, coefficients);
  for (int i = 0; i < 5; ++i) surface.solve(coefficients.data(), 3);
  const std::vector<Reading> more{{5, 4, true, true, 0.9F, 500.0F, 30.0F}};
  addAll(surface, more, coefficients);
  for (int i = 0; i < 100; ++i) surface.solve(coefficients.data(), 3);
  readings.push_back(more.front());
  expectNear(coefficients,
             solvedDensely(readings, 400.0, 1.0, std::vector<float>(kRows * kColumns, 20.0F)));
}

TEST(SurfaceInformation, FadingLeavesThePrior) {
  const std::vector<Reading> readings = someReadings();
  std::vector<float> coefficients(kRows * kColumns, 20.0F);
  const Eigen::VectorXd expected = solvedDensely(readings, 50.0, 0.01, coefficients);
  SurfaceInformation surface(kRows, kColumns);
  surface.begin(50.0);
  addAll(surface, readings, coefficients);
  surface.fade(coefficients.data(), 0.01F);
  surface.solve(coefficients.data(), 300);
  expectNear(coefficients, expected);
  // A new begin leaves nothing of the readings.
  surface.begin(50.0);
  std::vector<float> untouched(kRows * kColumns, 7.0F);
  surface.solve(untouched.data(), 10);
  EXPECT_EQ(untouched, std::vector<float>(kRows * kColumns, 7.0F));
}

TEST(SurfaceInformation, NeedsPlacesInsideOfTheBoundary) {
  EXPECT_THROW(SurfaceInformation(6, 20), std::invalid_argument);
  EXPECT_THROW(SurfaceInformation(20, 7), std::invalid_argument);
  EXPECT_NO_THROW(SurfaceInformation(7, 8));
}

}  // namespace
}  // namespace palpate::surface_information_test

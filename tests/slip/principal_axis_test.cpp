#include "palpate/slip/principal_axis.h"

#include <cmath>

#include "slip_scene.h"
#include "testing/testing.h"

namespace palpate::principal_axis_test {
namespace {

PrincipalAxis axisOf(const MatrixValues& values) {
  return principalAxis(contactMoments(testing::viewOf(values)));
}

TEST(PrincipalAxis, OfABlockIsTheClosedForm) {
  MatrixValues values = MatrixValues::Zero(14, 6);
  values.block(2, 1, 5, 3).setConstant(100.0F);  // 5 rows, 3 columns: variances (n^2 - 1)/12
  const PrincipalAxis axis = axisOf(values);
  EXPECT_NEAR(axis.lambda1, 2.0, 1e-12);
  EXPECT_NEAR(axis.lambda2, 2.0 / 3.0, 1e-12);
  EXPECT_DOUBLE_EQ(axis.orientationDeg, 90.0);
  EXPECT_NEAR(axis.eccentricity, std::sqrt(2.0 / 3.0), 1e-12);
  EXPECT_NEAR(axis.studyEccentricity, std::sqrt(8.0 / 9.0), 1e-12);
  EXPECT_NEAR(axis.skewX, 0.0, 1e-12);
  EXPECT_NEAR(axis.skewY, 0.0, 1e-12);
}

TEST(PrincipalAxis, OfADiagonalIsFortyFiveDegreesDownwards) {
  MatrixValues values = MatrixValues::Zero(6, 6);
  for (int i = 0; i < 5; ++i) values(i, i) = 50.0F;
  EXPECT_NEAR(axisOf(values).orientationDeg, 45.0, 1e-9);
  EXPECT_NEAR(axisOf(values).eccentricity, 1.0, 1e-6);
  MatrixValues other = MatrixValues::Zero(6, 6);
  for (int i = 0; i < 5; ++i) other(i, 5 - i) = 50.0F;
  EXPECT_NEAR(axisOf(other).orientationDeg, 135.0, 1e-9);
}

TEST(PrincipalAxis, SkewnessPointsToTheLongTail) {
  MatrixValues values = MatrixValues::Zero(1, 6);
  values << 8.0F, 4.0F, 2.0F, 1.0F, 0.0F, 0.0F;
  double mean = 0.0;
  for (int x = 0; x < 6; ++x) mean += x * static_cast<double>(values(0, x)) / 15.0;
  double second = 0.0;
  double third = 0.0;
  for (int x = 0; x < 6; ++x) {
    second += std::pow(x - mean, 2) * static_cast<double>(values(0, x)) / 15.0;
    third += std::pow(x - mean, 3) * static_cast<double>(values(0, x)) / 15.0;
  }
  EXPECT_NEAR(axisOf(values).skewX, third / std::pow(second, 1.5), 1e-9);
  EXPECT_GT(axisOf(values).skewX, 0.5);
  // A single row has no extent.
  EXPECT_EQ(axisOf(values).skewY, 0.0);
}

TEST(PrincipalAxis, OfNothingOrOneTaxelIsNothing) {
  MatrixValues values = MatrixValues::Zero(14, 6);
  EXPECT_EQ(axisOf(values).lambda1, 0.0);
  values(13, 5) = 3.0F;
  const PrincipalAxis axis = axisOf(values);
  EXPECT_NEAR(axis.lambda1, 0.0, 1e-12);
  EXPECT_EQ(axis.eccentricity, 0.0);
  EXPECT_EQ(axis.orientationDeg, 0.0);
}

}  // namespace
}  // namespace palpate::principal_axis_test

#include "palpate/slip/contact_moments.h"

#include <cmath>
#include <limits>

#include "slip_scene.h"
#include "testing/testing.h"

namespace palpate::contact_moments_test {
namespace {

ContactMoments momentsOf(const MatrixValues& values) {
  return contactMoments(ConstMatrixMap(values.data(), values.rows(), values.cols()));
}

TEST(ContactMoments, AreTheSumsOfTheirDefinition) {
  MatrixValues values = MatrixValues::Zero(14, 6);
  for (int y = 3; y < 9; ++y)
    for (int x = 1; x < 6; ++x)
      values(y, x) = static_cast<float>((7 * y * y + 13 * x * y + x) % 97);
  double m00 = 0;
  double m10 = 0;
  double m01 = 0;
  int active = 0;
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 6; ++x) {
      const auto v = static_cast<double>(values(y, x));
      m00 += v;
      m10 += v * x;
      m01 += v * y;
      active += v > 0 ? 1 : 0;
    }
  const double cx = m10 / m00;
  const double cy = m01 / m00;
  double mu[5] = {0, 0, 0, 0, 0};
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 6; ++x) {
      const double v = static_cast<double>(values(y, x)) / m00;
      mu[0] += v * (x - cx) * (x - cx);
      mu[1] += v * (x - cx) * (y - cy);
      mu[2] += v * (y - cy) * (y - cy);
      mu[3] += v * std::pow(x - cx, 3);
      mu[4] += v * std::pow(y - cy, 3);
    }
  const ContactMoments moments = momentsOf(values);
  EXPECT_EQ(moments.active, active);
  EXPECT_DOUBLE_EQ(moments.sum, m00);
  EXPECT_NEAR(moments.x, cx, 1e-12);
  EXPECT_NEAR(moments.y, cy, 1e-12);
  EXPECT_NEAR(moments.mu20, mu[0], 1e-10);
  EXPECT_NEAR(moments.mu11, mu[1], 1e-10);
  EXPECT_NEAR(moments.mu02, mu[2], 1e-10);
  EXPECT_NEAR(moments.mu30, mu[3], 1e-10);
  EXPECT_NEAR(moments.mu03, mu[4], 1e-10);
}

TEST(ContactMoments, OfNothingAreNothing) {
  const ContactMoments moments = momentsOf(MatrixValues::Zero(13, 6));
  EXPECT_EQ(moments.active, 0);
  EXPECT_EQ(moments.sum, 0.0);
  EXPECT_EQ(moments.x, 0.0);
  EXPECT_EQ(moments.mu20, 0.0);
}

TEST(ContactMoments, OfOneTaxelAreItsPlace) {
  MatrixValues values = MatrixValues::Zero(14, 6);
  values(13, 5) = 4095.0F;
  const ContactMoments moments = momentsOf(values);
  EXPECT_EQ(moments.active, 1);
  EXPECT_DOUBLE_EQ(moments.x, 5.0);
  EXPECT_DOUBLE_EQ(moments.y, 13.0);
  EXPECT_NEAR(moments.mu20, 0.0, 1e-12);
  EXPECT_NEAR(moments.mu02, 0.0, 1e-12);
}

TEST(ContactMoments, LeaveOutWhatIsNoLoad) {
  MatrixValues values = MatrixValues::Zero(4, 4);
  values(1, 2) = 10.0F;
  // A filter may produce negative values.
  values(3, 3) = -50.0F;
  values(0, 0) = std::numeric_limits<float>::quiet_NaN();
  const ContactMoments moments = momentsOf(values);
  EXPECT_EQ(moments.active, 1);
  EXPECT_DOUBLE_EQ(moments.sum, 10.0);
  EXPECT_DOUBLE_EQ(moments.x, 2.0);
  EXPECT_DOUBLE_EQ(moments.y, 1.0);
}

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
}  // namespace palpate::contact_moments_test

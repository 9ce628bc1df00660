#include "palpate/recognition/standardisation.h"

#include <cmath>
#include <stdexcept>

#include "testing/testing.h"

namespace palpate::standardisation_test {
namespace {

TEST(Standardisation, TakesMeanAndPopulationDeviation) {
  Eigen::MatrixXd x(4, 2);
  x << 2, 10, 4, 10, 4, 30, 6, 30;  // sd: sqrt(2), 10
  const Standardisation fitted = Standardisation::of(x);
  EXPECT_DOUBLE_EQ(fitted.mean[0], 4.0);
  const Eigen::MatrixXd z = fitted.apply(x);
  EXPECT_DOUBLE_EQ(z(0, 0), -std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(z(3, 1), 1.0);
  EXPECT_DOUBLE_EQ(fitted.apply(Eigen::RowVector2d(4.0, 50.0))(0, 1), 3.0);
}

TEST(Standardisation, AConstantFeatureBecomesZero) {
  Eigen::MatrixXd x(3, 2);
  x << 0.1, 1, 0.1, 2, 0.1, 3;
  const Standardisation fitted = Standardisation::of(x);
  EXPECT_EQ(fitted.apply(Eigen::RowVector2d(99.0, 2.0))(0, 0), 0.0);
  EXPECT_TRUE(fitted.apply(x).allFinite());
}

TEST(Standardisation, RefusesOtherSizes) {
  EXPECT_THROW(Standardisation::of(Eigen::MatrixXd(0, 3)), std::invalid_argument);
  const Standardisation fitted = Standardisation::of(Eigen::MatrixXd::Random(3, 2));
  EXPECT_THROW(fitted.apply(Eigen::MatrixXd::Zero(1, 3)), std::invalid_argument);
  EXPECT_THROW(fitted.apply(Eigen::MatrixXd::Zero(1, 1)), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::standardisation_test

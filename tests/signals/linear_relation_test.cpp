#include "palpate/signals/linear_relation.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "reference_signals.h"
#include "testing/testing.h"

namespace palpate::linear_relation_test {
namespace {

// numpy 1.24: polyfit(a, y, 1), corrcoef(a, y), residuals with n - 2; y = 3 - 2 a + b / 2.
TEST(LinearRelation, IsNumPys) {
  const std::vector<double> a = testing::referenceNoise(1), b = testing::referenceNoise(2);
  std::vector<double> y;
  for (std::size_t i = 0; i < a.size(); ++i) y.push_back(3.0 - 2.0 * a[i] + 0.5 * b[i]);
  const LinearRelation relation = linearRelation(a, y);
  EXPECT_EQ(relation.count, 600u);
  EXPECT_NEAR(relation.slope, -2.01484724986, 1e-10);
  EXPECT_NEAR(relation.intercept, 3.01148997341, 1e-10);
  EXPECT_NEAR(relation.correlation, -0.971091127695, 1e-11);
  EXPECT_NEAR(relation.residualSd, 0.143423101387, 1e-11);
}

TEST(LinearRelation, UsesOnlyWholePairs) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const LinearRelation relation =
      linearRelation(std::vector{1.0, 2.0, nan, 4.0}, std::vector{1.0, 3.0, 5.0, nan});
  EXPECT_EQ(relation.count, 2u);
  EXPECT_NEAR(relation.slope, 2.0, 1e-12);
  EXPECT_NEAR(relation.correlation, 1.0, 1e-12);
  EXPECT_TRUE(std::isnan(relation.residualSd));
}

TEST(LinearRelation, OfWhatDoesNotChangeIsUnknown) {
  const LinearRelation still = linearRelation(std::vector{1.0, 1.0}, std::vector{1.0, 3.0});
  EXPECT_TRUE(std::isnan(still.slope));
  const LinearRelation flat =
      linearRelation(std::vector{1.0, 2.0, 3.0}, std::vector{5.0, 5.0, 5.0});
  EXPECT_EQ(flat.slope, 0.0);
  EXPECT_TRUE(std::isnan(flat.correlation));
  EXPECT_EQ(linearRelation({}, {}).count, 0u);
  EXPECT_THROW(linearRelation(std::vector{1.0}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::linear_relation_test

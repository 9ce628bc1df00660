#include "palpate/calibration/student_t.h"

#include <cmath>

#include "testing/testing.h"

namespace palpate::student_t_test {
namespace {

// Printed tables (NIST/SEMATECH e-Handbook 1.3.6.7.2, column 0.975; three decimals).
TEST(StudentT, AgreesWithPrintedTables) {
  const double table[][2] = {{1, 12.706},
                             {2, 4.303},
                             {3, 3.182},
                             {4, 2.776},
                             {5, 2.571},
                             {6, 2.447},
                             {7, 2.365},
                             {8, 2.306},
                             {10, 2.228},
                             {15, 2.131},
                             {20, 2.086},
                             {30, 2.042},
                             {60, 2.000},
                             {100, 1.984},
                             {1e9, 1.960}};
  for (const auto& [dof, quantile] : table)
    EXPECT_NEAR(studentQuantile975(dof), quantile, 8e-4) << dof;
}

// C-A15. Roots of the incomplete beta function (DLMF 8.17) in 30 digits, by mpmath.
TEST(StudentT, HoldsBetweenSmallWholeNumbersAndIsNaNBelowOne) {
  EXPECT_NEAR(studentQuantile975(1.2), 8.64882651075, 1e-9);
  EXPECT_NEAR(studentQuantile975(1.5), 6.01666310443, 1e-9);
  EXPECT_NEAR(studentQuantile975(2.5), 3.574654842, 1e-9);
  EXPECT_TRUE(std::isnan(studentQuantile975(0.5)));
  EXPECT_TRUE(std::isnan(studentQuantile975(std::nan(""))));
}

}  // namespace
}  // namespace palpate::student_t_test

#include "palpate/calibration/student_t.h"

#include <cmath>
#include <limits>

namespace palpate {

double studentQuantile975(double dof) {
  if (!(dof >= 1.0)) return std::numeric_limits<double>::quiet_NaN();
  constexpr double kSmall[] = {12.706205, 4.302653, 3.182446, 2.776445, 2.570582};
  if (dof < 5.0) {
    const int below = static_cast<int>(dof);
    const double part = dof - below;
    return kSmall[below - 1] * (1.0 - part) + kSmall[below] * part;
  }
  constexpr double z = 1.959963984540054;
  constexpr double z2 = z * z;
  // Abramowitz and Stegun 26.7.5
  const double g1 = (z2 + 1.0) * z / 4.0;
  const double g2 = ((5.0 * z2 + 16.0) * z2 + 3.0) * z / 96.0;
  const double g3 = (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) * z / 384.0;
  const double g4 =
      ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) * z / 92160.0;
  const double r = 1.0 / dof;
  return z + r * (g1 + r * (g2 + r * (g3 + r * g4)));
}

}  // namespace palpate

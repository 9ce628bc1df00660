#include "palpate/calibration/student_t.h"

#include <limits>

#include <boost/math/distributions/students_t.hpp>

namespace palpate {

double studentQuantile975(double dof) {
  if (!(dof >= 1.0)) return std::numeric_limits<double>::quiet_NaN();
  return boost::math::quantile(boost::math::students_t(dof), 0.975);
}

}  // namespace palpate

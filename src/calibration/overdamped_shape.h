// The shape phi(t) of a step response with d >= 1, prepared for many times: the inner loop of the
// fit.
#pragma once

#include <cmath>

#include "palpate/calibration/step_model.h"

namespace palpate {

// Returns (1 - e^-x) / x for x >= 0; 1 at x = 0.
inline double decayQuotient(double x) {
  if (x < 0.01) return 1.0 - x / 2.0 * (1.0 - x / 3.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0)));
  return (1.0 - std::exp(-x)) / x;
}

// With w = 1/T2 - 1/T1, g = (1 - e^(-wt)) / (wt):
//   phi = 1 - e^(-t/T1) (1 + t/T1 g)
// It has no difference of nearly equal numbers where T1 is close to T2.
class OverdampedShape {
 public:
  OverdampedShape(double t1S, double t2S)
      : perT1_(1.0 / t1S), perT2_(1.0 / t2S), difference_((t1S - t2S) / (t1S * t2S)) {}

  StepShape at(double tS) const {
    if (!(tS > 0.0)) return {};
    const double s = tS * perT1_;
    const double slow = std::exp(-s);
    const double g = decayQuotient(tS * difference_);
    const double rate = slow * s * g * perT2_;
    return {1.0 - slow * (1.0 + s * g), rate, -tS * rate, slow * s * (g - 1.0)};
  }

 private:
  double perT1_, perT2_, difference_;
};

}  // namespace palpate

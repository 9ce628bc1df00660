#include "palpate/calibration/drift_compensation.h"

#include <algorithm>
#include <cmath>

namespace palpate {

double DriftCompensation::gainOf(const Surface& driftOfGain,
                                 double timeS,
                                 double reading,
                                 double degC) {
  compensating_ = false;
  if (!(reading > 0.0)) {
    beganS_.reset();
    last_ = 0.0;
    return 0.0;
  }
  const double since = beganS_ ? timeS - *beganS_ : 0.0;
  const bool settled = since >= options_.steadyS;
  // Within the lag the reading rises by itself.
  if (!beganS_ || since < 0.0 ||
      (settled && std::abs(reading - last_) > options_.sameLoadShare * last_))
    beganS_ = timeS;
  last_ = reading;
  const double t = std::min(timeS - *beganS_, options_.longestS);
  if (!driftOfGain.valid || t < options_.steadyS) return reading;
  double gain = reading;
  // Newton's steps for K + m(K) t = a; m is nearly linear in K.
  for (int i = 0; i < 3; ++i) {
    const SurfaceEstimate drift = driftOfGain.at(gain, degC);
    const double slope = 1.0 + drift.byX * t;
    if (!std::isfinite(drift.value) || !(slope > 0.0)) return reading;
    gain =
        std::clamp(gain - (gain + drift.value * t - reading) / slope, 0.5 * reading, 1.5 * reading);
  }
  compensating_ = true;
  return gain;
}

}  // namespace palpate

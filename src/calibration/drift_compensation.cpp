#include "palpate/calibration/drift_compensation.h"

#include <algorithm>
#include <cmath>

#include "palpate/model/tactile_frame.h"

namespace palpate {

double DriftCompensation::gainOf(const Surface& driftOfGain,
                                 double timeS,
                                 double reading,
                                 double degC) {
  compensating_ = false;
  startUnknown_ = false;
  const bool loaded = isTouched(reading);
  if (!anyReading_) loadedFromFirstReading_ = loaded;
  anyReading_ = true;
  if (!beganS_ || timeS < *beganS_) {
    beganS_.reset();
    otherSinceS_.reset();
    if (!loaded) return 0.0;
    beganS_ = timeS;
  }
  // During the lag the reading rises although the load is constant.
  const bool settled = timeS - *beganS_ >= options_.steadyS;
  const bool other =
      !loaded || (settled && std::abs(reading - last_) > options_.sameLoadFraction * last_);
  if (!other) {
    otherSinceS_.reset();
    last_ = reading;
  } else {
    if (!otherSinceS_) otherSinceS_ = timeS;
    if (timeS - *otherSinceS_ >= options_.debounceS) {
      beganS_ = loaded ? otherSinceS_ : std::nullopt;
      otherSinceS_.reset();
      last_ = reading;
      loadedFromFirstReading_ = false;
    }
  }
  if (!loaded || !beganS_) return 0.0;
  const double t = std::min(timeS - *beganS_, options_.maxDurationS);
  startUnknown_ = loadedFromFirstReading_ && t < options_.maxDurationS;
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

// Removes creep from a lasting contact: under a constant load the rubber responds with K + m t
// (study, 3.1), where the rate m [counts/s] depends on K and the temperature. After the lag has
// ended, the reading a at time t gives K = a - m(K, T) t.
#pragma once

#include <optional>

#include <palpate/calibration/surface.h>

namespace palpate {

struct DriftCompensationOptions {
  double steadyS = 1.0;        // the lag is over so long after contact began [s]
  double maxDurationS = 30.0;  // creep was measured so long; later it counts as ended [s]
  // Relative change of the reading above which the load is taken as changed, if the change lasts at
  // least debounceS: single frames change when a taxel at the edge becomes active or inactive.
  double sameLoadFraction = 0.15;
  double debounceS = 0.1;  // [s]
};

// Of one contact, frame by frame; not thread-safe.
class DriftCompensation {
 public:
  explicit DriftCompensation(DriftCompensationOptions options = {}) : options_(options) {}

  // K [counts] of a reading at a time [s]; 0 ends the contact. driftOfGain: m(K, T) [counts/s];
  // where it isn't known the reading itself.
  double gainOf(const Surface& driftOfGain, double timeS, double reading, double degC);
  bool compensating() const noexcept { return compensating_; }  // in the last call
  void reset() noexcept {
    beganS_.reset();
    otherSinceS_.reset();
  }

 private:
  DriftCompensationOptions options_;
  std::optional<double> beganS_, otherSinceS_;
  double last_ = 0.0;
  bool compensating_ = false;
};

}  // namespace palpate

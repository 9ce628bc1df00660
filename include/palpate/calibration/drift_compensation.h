// Removes creep from a lasting contact, for PressureMap: under a constant load the rubber responds
// with K + m t (study, 3.1), where the rate m [counts/s] depends on K and the temperature. After
// the lag has ended, the reading a at time t gives K = a - m(K, T) t.
#pragma once

#include <optional>

#include <palpate/calibration/surface.h>

namespace palpate {

struct DriftCompensationOptions {
  // Time from the start of contact to the end of the lag [s].
  double steadyS = 1.0;
  static constexpr double kLongestS = 30.0;  // the largest maxDurationS of a PressureMap
  // For how long the creep was measured [s]. It slows down, so what is subtracted doesn't grow any
  // more afterwards. 10 s: most of the study's steps are a little longer (6 to 14 s).
  double maxDurationS = 10.0;
  // Relative change of the reading above which the load is taken as changed, if the change lasts at
  // least debounceS: single frames change when a taxel at the edge becomes active or inactive.
  double sameLoadFraction = 0.15;
  double debounceS = 0.1;  // [s]
};

// Compensates one contact, frame by frame; not thread-safe.
class DriftCompensation {
 public:
  explicit DriftCompensation(DriftCompensationOptions options = {}) : options_(options) {}

  // Returns K [counts] for a reading at a time [s]; a reading of 0 ends the contact. `driftOfGain`
  // gives m(K, T) [counts/s]; where it is not known, the result is the reading itself.
  double gainOf(const Surface& driftOfGain, double timeS, double reading, double degC);
  bool compensating() const noexcept { return compensating_; }  // whether the last call did
  // Whether the load of the last call was there at the first reading, so that its true start is not
  // known and may make a difference: for maxDurationS after the first reading.
  bool startUnknown() const noexcept { return startUnknown_; }
  void reset() noexcept { *this = DriftCompensation(options_); }

 private:
  DriftCompensationOptions options_;
  std::optional<double> beganS_, otherSinceS_;
  double last_ = 0.0;
  bool compensating_ = false;
  bool anyReading_ = false;              // whether there was a call since reset()
  bool loadedFromFirstReading_ = false;  // the present load
  bool startUnknown_ = false;
};

}  // namespace palpate

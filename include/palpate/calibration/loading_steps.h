// Finds the loading steps of one matrix: spans in which a constant load was applied. The signal (by
// default the filtered mean, eq. 3.2 of the study) rises from 0; a step begins with the last
// unloaded frame, which is t = 0 of its fit, and ends before the load is removed.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/signals/characteristic_signals.h>

namespace palpate {

struct LoadingStepOptions {
  SignalKind signal = SignalKind::kFilteredMean;
  double aboveCounts = 0.0;       // loaded: the signal is above [its unit], >= 0
  double minDurationS = 1.0;      // shorter contacts are no steps [s], >= 0
  std::size_t minFrames = 20;     // nor such of fewer frames; >= 6
  std::size_t bridgedFrames = 3;  // an unloaded stretch of at most so many frames is flicker
  // The load is being taken away where the signal stays below this share of its level (median of
  // the second half) until it is 0; 0..1.
  double releaseFraction = 0.95;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// Frames begin..end, both inclusive.
struct LoadingStep {
  std::size_t begin = 0;
  std::size_t end = 0;
  // false: loaded from the recording's first frame, or behind a gap: no t = 0
  bool beginSeen = true;
  bool released = false;          // the load was taken away inside the recording
  std::size_t flickerFrames = 0;  // bridged
  bool operator==(const LoadingStep&) const = default;
};

// What the frames of one matrix say, in order.
struct StepSignal {
  std::vector<double> timeS;         // from the first frame [s]
  std::vector<double> values;        // the characteristic signal
  std::vector<int> activeTaxels;     // taxels above 0; empty: not known
  std::vector<int> saturatedTaxels;  // taxels at or above the sensor's saturation; empty: not known
  // taxels that became active or inactive since the frame before; empty: not known
  std::vector<int> toggledTaxels;
};
// Of one matrix of a profile. Throws std::out_of_range (no such matrix), Cancelled.
StepSignal stepSignal(const Profile& profile,
                      std::size_t matrix,
                      SignalKind signal = SignalKind::kFilteredMean,
                      const Progress& progress = {});

// Values that are no numbers count as unloaded. A gap (longer than max(1 s, 5 median intervals))
// ends a step. Throws std::invalid_argument (options; series of different lengths).
std::vector<LoadingStep> findLoadingSteps(const StepSignal& signal,
                                          const LoadingStepOptions& options = {});

}  // namespace palpate

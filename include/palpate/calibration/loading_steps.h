// Finds the loading steps of one matrix: spans in which a constant load was applied. The signal (by
// default the filtered mean, eq. 3.2 of the study) rises from 0. A step begins with the last
// unloaded frame, which is t = 0 of its fit, and ends before the load is removed. step_report.h
// fits the steps.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <palpate/core/option_check.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/signals/characteristic_signals.h>

namespace palpate {

// What counts as a loading step.
struct LoadingStepOptions {
  SignalKind signal = SignalKind::kFilteredMean;
  static constexpr OptionRange kAboveCounts{0.0, 1e6};
  static constexpr OptionRange kMinDurationS{0.0, 86'400.0, "s"};
  double aboveCounts = 0.0;   // the matrix is loaded when the signal is above this
  double minDurationS = 1.0;  // shorter contacts are no steps [s]
  // Contacts with fewer frames are no steps; >= 6.
  std::size_t minFrames = 20;
  // Unloaded stretches of at most this many frames are ignored as flicker.
  std::size_t bridgedFrames = 3;
  // The load is being removed from where the signal stays below this share of its level (median of
  // the second half) until it is 0; 0..1.
  double releaseFraction = 0.95;

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// Frames begin..end, both inclusive.
struct LoadingStep {
  std::size_t begin = 0;
  std::size_t end = 0;
  // Whether the start is in the recording. False when the matrix is loaded from the recording's
  // first frame or after a gap: then t = 0 is not known.
  bool beginSeen = true;
  bool released = false;          // the load was removed within the recording
  std::size_t flickerFrames = 0;  // ignored flicker
  bool operator==(const LoadingStep&) const = default;
};

// The signal of one matrix, frame by frame.
struct StepSignal {
  std::vector<double> timeS;   // from the first frame [s]
  std::vector<double> values;  // the characteristic signal
  // Taxels above 0; empty when not known.
  std::vector<int> activeTaxels;
  // Taxels at or above the sensor's saturation; empty when not known.
  std::vector<int> saturatedTaxels;
  // Taxels that became active or inactive since the previous frame; empty when not known.
  std::vector<int> toggledTaxels;
};
// Computes the signal of one matrix of a profile. Throws std::out_of_range (no such matrix),
// Cancelled.
StepSignal stepSignal(const Profile& profile,
                      std::size_t matrix,
                      SignalKind signal = SignalKind::kFilteredMean,
                      const Progress& progress = {});

// Values that are not finite count as unloaded. A gap (longer than max(1 s, 5 median intervals))
// ends a step. Throws std::invalid_argument (options; series of different lengths).
std::vector<LoadingStep> findLoadingSteps(const StepSignal& signal,
                                          const LoadingStepOptions& options = {});

}  // namespace palpate

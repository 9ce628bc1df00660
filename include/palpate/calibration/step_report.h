// Reports the loading steps of a matrix of one recording, each with its fit and its problems:
// saturated or flickering taxels, an unseen start, a load that changed. The command `calibrate
// step` and the calibrations use it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <palpate/calibration/loading_steps.h>
#include <palpate/calibration/step_fit.h>
#include <palpate/core/json.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>

namespace palpate {

struct StepReportOptions {
  LoadingStepOptions steps = {};
  StepFitOptions fit = {};
};

// One loading step with its fit.
struct FittedStep {
  LoadingStep step;
  StepFit fit;
  StepCharacteristics characteristics;  // only when the fit converged
  // Mean over the step [deg C] of the sensor nearest to the matrix, and of all sensors; empty when
  // not recorded.
  std::optional<double> nearestDegC;
  std::optional<double> allSensorsDegC;
  // Temperature by the study's rule: the mean of all sensors in the single sample of the recording
  // whose number is that of the matrix.
  std::optional<double> studyDegC;
  double durationS = 0.0;           // from its first to its last frame [s]
  std::size_t saturatedFrames = 0;  // frames with a saturated taxel
  double activeAreaMm2 = 0.0;       // active area, mean of the second half [mm^2]
  // Taxels that become active or inactive, per frame of the second half.
  double toggledPerFrame = 0.0;
  // Notes about the step; those about the fit are in fit.notes.
  std::vector<std::string> notes;

  // Returns whether K and m can be used for a calibration: the fit is usable, the start was seen,
  // and nothing was saturated.
  bool usable() const noexcept;
};

// All loading steps of one matrix of a recording.
struct StepReport {
  std::size_t matrix = 0;
  SignalKind signal = SignalKind::kFilteredMean;
  std::vector<FittedStep> steps;
  // What is missing in the whole recording.
  std::vector<std::string> notes;
};

// Throws std::out_of_range (no such matrix), std::invalid_argument (options), Cancelled.
StepReport reportSteps(const Profile& profile,
                       std::size_t matrix,
                       const StepReportOptions& options = {},
                       const Progress& progress = {});
// Does the same with a signal of the matrix that was already computed.
StepReport reportSteps(const Profile& profile,
                       std::size_t matrix,
                       const StepSignal& signal,
                       const StepReportOptions& options = {});

// Returns the time [s] from the step's start and the signal, as used for the fit; charts of the
// residuals use it, too.
StepSignal samplesOf(const StepSignal& signal, const LoadingStep& step);

// Output of `calibrate step`: begin, end, K, m, T1, T2, T, d, rmse, converged, identifiable,
// covariance (4x4, in the order K, m, T1, T2), and more.
Json jsonOf(const StepReport& report);

}  // namespace palpate

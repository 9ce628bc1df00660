// The loading steps of a matrix of one recording, each with its fit and with what speaks against
// it: saturated or flickering taxels, a begin that wasn't seen, a load that changed.
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

struct FittedStep {
  LoadingStep step;
  StepFit fit;
  StepCharacteristics characteristics;  // only where the fit converged
  // Mean over the step [deg C]: of the sensor nearest to the matrix, and of all; nothing: not
  // recorded.
  std::optional<double> nearestDegC;
  std::optional<double> allSensorsDegC;
  // What the study took: all sensors of the one sample of the recording whose number is the
  // matrix's.
  std::optional<double> studyDegC;
  std::size_t saturatedFrames = 0;  // frames with a saturated taxel
  double activeAreaMm2 = 0.0;       // of the active taxels, mean of the second half [mm^2]
  double toggledPerFrame = 0.0;     // taxels that come and go, per frame of the second half
  std::vector<std::string> notes;   // of the step; those of the fit are in fit.notes

  // K and m may be calibrated with: the fit is usable, begin seen, and nothing saturated.
  bool usable() const noexcept;
};

struct StepReport {
  std::size_t matrix = 0;
  SignalKind signal = SignalKind::kFilteredMean;
  std::vector<FittedStep> steps;
  std::vector<std::string> notes;  // what is missing in the whole recording
};

// Throws std::out_of_range (no such matrix), std::invalid_argument (options), Cancelled.
StepReport reportSteps(const Profile& profile,
                       std::size_t matrix,
                       const StepReportOptions& options = {},
                       const Progress& progress = {});
// From the signal of the matrix, for whoever has it already.
StepReport reportSteps(const Profile& profile,
                       std::size_t matrix,
                       const StepSignal& signal,
                       const StepReportOptions& options = {});

// Time [s] from the step's begin, and the signal: what was fitted, and what residuals are drawn
// against.
StepSignal samplesOf(const StepSignal& signal, const LoadingStep& step);

// The promise of `calibrate step`: begin, end, K, m, T1, T2, T, d, rmse, converged, identifiable,
// covariance (4x4, in the order K, m, T1, T2), and more.
Json jsonOf(const StepReport& report);

}  // namespace palpate

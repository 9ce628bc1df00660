// Fits the step response of step_model.h by least_squares.h: K and m are linear and follow from the
// shape, so only its two parameters are searched (variable projection), from the best places of a
// grid: at or below the residual of a four-parameter search in all measured steps, where that
// search fails from poor starts.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <palpate/calibration/step_model.h>

namespace palpate {

enum class StepLoss { kSquares, kHuber, kCauchy };
enum class StepDamping {
  kOverdamped,  // d >= 1, as the study fits
  kAny,         // also oscillating ones (d < 1), where they explain the data better
};

struct StepFitOptions {
  StepLoss loss = StepLoss::kSquares;
  // Robust losses: residuals beyond this many standard deviations (robust, by the median) count
  // less; > 0. The customary 1.345 (Huber) and 2.385 (Cauchy) cost 5 % of the precision where all
  // is normal; 0 takes these.
  double lossScale = 0.0;
  StepDamping damping = StepDamping::kOverdamped;
  int maxIterations = 60;  // of one search, >= 1

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct StepFit {
  static constexpr double kNotFitted = std::numeric_limits<double>::quiet_NaN();
  // All NaN where nothing was fitted, as rmse and residualSd.
  StepParameters parameters = {.staticResponseCounts = kNotFitted,
                               .driftCountsPerS = kNotFitted,
                               .timeConstantS = kNotFitted,
                               .damping = kNotFitted};
  std::size_t numSamples = 0;  // used
  std::size_t numDropped = 0;  // not finite, or before t = 0
  double rmse = kNotFitted;    // sqrt(mean square of all residuals) [counts]
  // sqrt(sum of (weighted) squares / (n - 4)): what the covariance rests on
  double residualSd = kNotFitted;
  // Of K, m, T1, T2 (of an oscillating one: K, m, T, d), linearised at the solution; NaN where it
  // can't be had.
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Constant(kNotFitted);
  bool converged = false;     // a minimum was found
  bool identifiable = false;  // all four parameters are determined by the data
  // The lag has ended (phi >= 95 %) before the data end, so that K and m can be estimated
  // separately.
  bool steadyStateReached = false;
  std::size_t numDownweighted = 0;  // robust losses: samples that count less than half
  int evaluations = 0;              // of the model, over all starts
  std::vector<std::string> notes;   // what is missing or doubtful, a sentence each

  bool usable() const noexcept {
    return converged && steadyStateReached;
  }  // K and m may be calibrated with
  // Standard deviation of K, m, T1 or T2 (0..3).
  double sd(int parameter) const;
  // Half width of the 95 % interval (Student's t with n - 4 degrees of freedom).
  double interval95(int parameter) const;
};

// timeS [s] from the step's begin, in any order; values [counts]. Never throws for data: what can't
// be fitted says so in notes. Throws std::invalid_argument (options; spans of different sizes).
StepFit fitStep(std::span<const double> timeS,
                std::span<const double> values,
                const StepFitOptions& options = {});

}  // namespace palpate

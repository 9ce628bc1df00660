// Fits the step response of step_model.h with least_squares.h. K and m are linear and follow from
// the shape, so only the two parameters of the shape are searched (variable projection), from the
// best points of a grid. In all measured steps the residual is at or below that of a four-parameter
// search, which fails from poor starts.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <palpate/calibration/step_model.h>
#include <palpate/core/option_check.h>

namespace palpate {

// The loss of the fit (least_squares.h).
enum class StepLoss { kSquares, kHuber, kCauchy };
inline constexpr std::array<OptionWord<StepLoss>, 3> kStepLossWords{
    {{"squares", StepLoss::kSquares}, {"huber", StepLoss::kHuber}, {"cauchy", StepLoss::kCauchy}}};
// Which dampings d the fit may use.
enum class StepDamping {
  // d >= 1, as the study fits.
  kOverdamped,
  kAny,  // d < 1 (oscillating) is allowed where it fits the data better
};
inline constexpr std::array<OptionWord<StepDamping>, 2> kStepDampingWords{
    {{"over", StepDamping::kOverdamped}, {"any", StepDamping::kAny}}};

struct StepFitOptions {
  StepLoss loss = StepLoss::kSquares;
  // For robust losses: residuals beyond this many standard deviations (robust, from the median)
  // have less weight; >= 0. The usual values 1.345 (Huber) and 2.385 (Cauchy) cost 5 % of the
  // precision for normally distributed noise; 0 selects them.
  double lossScale = 0.0;
  StepDamping damping = StepDamping::kOverdamped;
  int maxIterations = 60;  // of one search, >= 1

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// Result of the fit of one step.
struct StepFit {
  static constexpr double kNotFitted = std::numeric_limits<double>::quiet_NaN();
  // All are NaN when nothing was fitted, also rmse and residualSd.
  StepParameters parameters = {.staticResponseCounts = kNotFitted,
                               .driftCountsPerS = kNotFitted,
                               .timeConstantS = kNotFitted,
                               .damping = kNotFitted};
  std::size_t numSamples = 0;  // used
  // Samples that were not used because they are not finite or before t = 0.
  std::size_t numDropped = 0;
  double rmse = kNotFitted;  // sqrt(mean square of all residuals) [counts]
  // sqrt(sum of (weighted) squares / (n - 4)) [counts].
  double residualSd = kNotFitted;
  // Covariance of K, m, T1, T2 (with d < 1: of K, m, T, d), linearised at the solution, for noise
  // that is as correlated from sample to sample as the residuals show; NaN when it cannot be
  // computed. With T1 = T2 only those of K and m are numbers.
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Constant(kNotFitted);
  // Degrees of freedom of Student's t for the intervals.
  double degreesOfFreedom = kNotFitted;
  // Half widths of the 95 % intervals in the order of the covariance; NaN where none can be stated:
  // of all when K isn't determined, of T1 and T2 when they are equal.
  Eigen::Vector4d halfIntervals = Eigen::Vector4d::Constant(kNotFitted);
  bool converged = false;  // a minimum was found
  // The data determine K (its 95 % interval is within +-50 %), and the fit converged.
  bool identifiable = false;
  // The data don't determine K: its interval is wider than that, or other shapes with another K
  // explain them as well. Also known where the search ended without a minimum.
  bool gainUndetermined = false;
  // Whether the data determine T1 and T2 (d < 1: T and d), too.
  bool timesIdentifiable = false;
  // The lag has ended (phi >= 95 %) before the data end, also with T1 (d < 1: T) at the upper end
  // of its interval, so that K and m can be estimated separately.
  bool steadyStateReached = false;
  // Number of samples with less than half weight (robust losses).
  std::size_t numDownweighted = 0;
  int evaluations = 0;  // number of points at which the model was evaluated, over all starts
  std::vector<std::string> notes;  // what is missing or doubtful, one sentence each

  // K and m can be used for a calibration; only what is identifiable is usable.
  bool usable() const noexcept { return identifiable && steadyStateReached; }
  // Standard deviation of K, m, T1 or T2 (0..3).
  double sd(int parameter) const;
  // Half width of the 95 % interval of K, m, T1 or T2 (0..3).
  double interval95(int parameter) const;
};

// Fits a step. timeS [s] is counted from the step's start, in any order; values in [counts]. Never
// throws because of the data: `notes` says what cannot be fitted. Throws std::invalid_argument
// (options; spans of different sizes).
StepFit fitStep(std::span<const double> timeS,
                std::span<const double> values,
                const StepFitOptions& options = {});

}  // namespace palpate

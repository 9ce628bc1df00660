// The search that step_fit uses: the two parameters of the shape by least_squares.h, K and m by
// variable projection (Golub and Pereyra, SIAM J. Numer. Anal. 10, 1973).
#pragma once

#include <vector>

#include <Eigen/Core>

#include "palpate/calibration/least_squares.h"
#include "palpate/calibration/step_model.h"

namespace palpate {

// Samples sorted by time from t >= 0; both vectors have the same size, and at least one time is
// above 0.
struct StepSamples {
  std::vector<double> timeS;
  std::vector<double> values;  // [counts]
};

// The coordinates of the search, within bounds.
//   kAperiodic:   (log M, q), 0 <= q <= 1: T1,2 = leastT2S + M (1 +- sqrt(1 - q)). The shape is
//                 smooth in q at both ends, T2 = leastT2S (q = 0) and T1 = T2 (q = 1).
//   kOscillating: (log T, d), 0.02 <= d <= 1.
enum class StepDomain { kAperiodic, kOscillating };

struct StepSearchOptions {
  StepDomain domain = StepDomain::kAperiodic;
  double leastT2S = 0.0;  // > 0 [s]
  double mostS = 0.0;     // upper limit of M and T [s]
  int maxIterations = 60;
};

// A shape of a coarse grid over the whole domain, with the K and m that fit best.
struct StepAlternative {
  double sumOfSquares = 0.0;
  double staticResponseCounts = 0.0;  // K
  double driftCountsPerS = 0.0;       // m
  double reachedGain = 0.0;           // phi at the last sample
};

struct StepMinimum {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  // coordinates in the domain
  StepParameters parameters;
  // With a robust loss, the sum of the losses; infinite when no shape of the domain fits.
  double sumOfSquares = 0.0;
  bool converged = false;
  int evaluations = 0;  // number of points at which the model was evaluated
  // With a robust loss: the weights of the samples, and the scale [counts] beyond which a residual
  // has less weight.
  std::vector<double> weights;
  double lossScale = 0.0;
  // The grid, with squares as the loss.
  std::vector<StepAlternative> alternatives;
};

// Returns the smallest of the minima that are found from the best points of a coarse grid.
StepMinimum searchStep(const StepSamples& samples, const StepSearchOptions& options);

// Goes from a minimum of squares to that of a robust loss, with all four parameters. A residual has
// less weight beyond `deviations` standard deviations; these follow from the median of the absolute
// residuals and are updated until they no longer change. Not converged when they don't settle.
StepMinimum searchRobustStep(const StepSamples& samples,
                             const StepSearchOptions& options,
                             const StepMinimum& start,
                             LeastSquaresLoss loss,
                             double deviations);

}  // namespace palpate

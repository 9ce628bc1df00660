// The search behind step_fit: the two parameters of the shape by least_squares.h, K and m by
// variable projection (Golub and Pereyra, SIAM J. Numer. Anal. 10, 1973).
#pragma once

#include <vector>

#include <Eigen/Core>

#include "palpate/calibration/least_squares.h"
#include "palpate/calibration/step_model.h"

namespace palpate {

// Samples in order of time from t >= 0; both of the same size, one time at least above 0.
struct StepSamples {
  std::vector<double> timeS;
  std::vector<double> values;  // [counts]
};

// What is searched, within bounds.
//   kAperiodic:   (log M, q), 0 <= q <= 1: T1,2 = leastT2S + M (1 +- sqrt(1 - q)). The shape is
//                 smooth in q at both ends, T2 = leastT2S (q = 0) and T1 = T2 (q = 1).
//   kOscillating: (log T, d), 0.02 <= d <= 1.
enum class StepDomain { kAperiodic, kOscillating };

struct StepSearchOptions {
  StepDomain domain = StepDomain::kAperiodic;
  double leastT2S = 0.0;  // > 0 [s]
  double mostS = 0.0;     // M and T at most [s]
  int maxIterations = 60;
};

struct StepMinimum {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  // coordinates of the domain
  StepParameters parameters;
  double sumOfSquares = 0.0;  // infinite: no shape of the domain fits
  bool converged = false;
  int evaluations = 0;  // of the model
  // Of a robust loss: the weights of the samples and the scale [counts] beyond which a residual
  // counts less.
  std::vector<double> weights;
  double lossScale = 0.0;
};

// The least of the minima that are found from the best places of a coarse grid.
StepMinimum searchStep(const StepSamples& samples, const StepSearchOptions& options);

// From a minimum of squares to that of a robust loss, by all four parameters. A residual counts
// less beyond `deviations` of their standard deviations, which the median of their sizes tells,
// anew until nothing changes.
StepMinimum searchRobustStep(const StepSamples& samples,
                             const StepSearchOptions& options,
                             const StepMinimum& start,
                             LeastSquaresLoss loss,
                             double deviations);

}  // namespace palpate

// Accuracy benchmark of the slip methods: each method measures synthetic contacts with known
// motion, and its errors are compared with the Cramer-Rao bound. The slip benchmark command and the
// Python module run it.
//
// For each shape and trial a contact moves on a random path of 100 frames within (+-0.6, +-1.2)
// taxels and +-15 deg (shapes with a direction), by at most about 0.13 taxel and 1 deg per frame.
// Then it leaves the matrix over the right edge by 1.5 taxels in 10 frames. Finally it rests while
// a load gradient of 40 % develops along the rows in 12 frames. Step errors and bounds are those of
// the first part. In further parts of 24 frames a load gradient of +40 or -40 % along the columns
// or along the rows develops in 12 frames and stays; the largest motion read in them is the worst
// tilt.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <palpate/core/option_check.h>
#include <palpate/core/progress.h>
#include <palpate/laboratory/synthetic_slip.h>
#include <palpate/slip/slip_motion.h>

namespace palpate {

// Processes a stream of frames of one matrix and returns the motion of each frame. The first frame
// is the reference.
using SlipEstimator = std::function<SlipMotion(const ConstMatrixMap&)>;

struct BenchmarkedMethod {
  std::string name;
  // Begins a new stream.
  std::function<SlipEstimator(const MatrixLayout&)> begin;
};
// All methods of SlipTracker, and the method `contest`. Callers may add others to the list.
std::vector<BenchmarkedMethod> benchmarkedMethods();

struct SlipAccuracyOptions {
  static constexpr OptionRange kNoiseSd{0.0, 1000.0, "counts"};
  static constexpr OptionRange kTrials{1, 1000};
  double noiseSd = 5.0;  // [counts]
  // Shapes to test; empty: all.
  std::vector<SlipShape> shapes = {};
  std::uint64_t seed = 1;
  // Trials per shape.
  int trials = 8;
  // Its noise is replaced by `noiseSd`.
  SyntheticSensor sensor = {};

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

struct SlipAccuracy {
  // Rms error of a step, per component [taxels].
  double rmse = 0.0;
  // Mean error of a step along its true direction [taxels].
  double bias = 0.0;
  // Regression coefficients of the measured on the true step; 1 is correct.
  double gainX = 0.0;
  double gainY = 0.0;
  // Rms error of the motion since the reference after 100 frames, per component [taxels], and of
  // the rotation [deg].
  double drift100 = 0.0;
  double driftDeg100 = 0.0;
  // The same after 10, 20, .. 100 frames [taxels].
  std::array<double, 10> drift = {};
  // Rms error of a step, per component, in the first ten frames and after them [taxels]. Only in
  // the first ones the shape of the contact between the taxels is unknown.
  double rmseFirst = 0.0;
  double rmseLater = 0.0;
  // Rms of the error of a step divided by the standard deviation that the method gives for it, over
  // the first ten frames and over those after them: 1 where the method knows its accuracy, 0 where
  // it gives none.
  double normalisedFirst = 0.0;
  double normalisedLater = 0.0;
  // Rms error of the rotation per frame [deg], over shapes with a direction.
  double rmseDeg = 0.0;
  // Rms of the Cramer-Rao bound over the same steps [taxels], [deg].
  double crb = 0.0;
  double crbDeg = 0.0;
  // Rms error of the motion of 1.5 taxels over the side edge [taxels].
  double edge = 0.0;
  // Rms motion reported at the end of a trial for a load gradient of 40 % without motion [taxels].
  double tilt = 0.0;
  // Largest motion read at any time under a load gradient of 40 % along the columns (x) and along
  // the rows (y), either sign, without motion [taxels].
  double worstTiltX = 0.0;
  double worstTiltY = 0.0;
  // Number of steps for which the method gave no motion.
  int invalid = 0;
  int steps = 0;
  double nsPerStep = 0.0;
};

struct ShapeAccuracy {
  SlipShape shape = SlipShape::kDisc;
  SlipAccuracy accuracy;
};
struct MethodAccuracy {
  std::string name;
  // Over all shapes.
  SlipAccuracy all;
  // Each shape by itself.
  std::vector<ShapeAccuracy> shapes;
};

// The same options give the same values, except the computing times. Throws Cancelled.
std::vector<MethodAccuracy> measureSlipAccuracy(const std::vector<BenchmarkedMethod>& methods,
                                                const SlipAccuracyOptions& options = {},
                                                const Progress& progress = {});

}  // namespace palpate

// How well methods measure slip, against contacts whose motion is known, and beside the Cramer-Rao
// bound.
//
// For each shape and trial a contact moves on a random path of 100 frames within (+-0.6, +-1.2)
// taxels and +-15 deg (shapes with a direction), by at most about 0.13 taxel and 1 deg per frame.
// Then it leaves the matrix over the right edge by 1.5 taxels in 10 frames. Finally it rests while
// a load gradient of 40 % develops along the rows in 12 frames. Step errors and bounds are those of
// the first part.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/slip/slip_motion.h>
#include <palpate/slip/synthetic_slip.h>

namespace palpate {

// One stream of frames of one matrix: gives the motion of each. The reference is the first.
using SlipEstimator = std::function<SlipMotion(const ConstMatrixMap&)>;

struct BenchmarkedMethod {
  std::string name;
  std::function<SlipEstimator(const MatrixLayout&)> begin;  // a new stream
};
// All methods of SlipTracker, and contest. Others may be added to such a list.
std::vector<BenchmarkedMethod> benchmarkedMethods();

struct SlipAccuracyOptions {
  double noiseSd = 5.0;                // [counts]
  std::vector<SlipShape> shapes = {};  // empty: all
  std::uint64_t seed = 1;
  int trials = 8;               // per shape, 1..1000
  SyntheticSensor sensor = {};  // its noise is noiseSd

  void validate() const;  // throws std::invalid_argument naming the field
};

struct SlipAccuracy {
  double rmse = 0.0;   // of a step, per component [taxels]
  double bias = 0.0;   // mean error of a step along its true direction [taxels]
  double gainX = 0.0;  // regression of the measured on the true step: 1 is right
  double gainY = 0.0;
  // rms error of the motion since the reference, after 100 frames, per component [taxels]
  double drift100 = 0.0;
  double driftDeg100 = 0.0;
  double rmseDeg = 0.0;  // of a turn per frame; over shapes with a direction
  double crb = 0.0;      // rms of the bound over the same steps [taxels]
  double crbDeg = 0.0;
  double edge = 0.0;  // rms error of the motion over the side edge, of 1.5 taxels
  // rms reading of a load tilt of 40 % without motion, per trial at its end [taxels]
  double tilt = 0.0;
  int invalid = 0;  // steps the method couldn't give
  int steps = 0;
  double nsPerStep = 0.0;
};

struct ShapeAccuracy {
  SlipShape shape = SlipShape::kDisc;
  SlipAccuracy accuracy;
};
struct MethodAccuracy {
  std::string name;
  SlipAccuracy all;                   // over all shapes
  std::vector<ShapeAccuracy> shapes;  // one by one
};

// The same options give the same figures, time apart. Throws Cancelled.
std::vector<MethodAccuracy> measureSlipAccuracy(const std::vector<BenchmarkedMethod>& methods,
                                                const SlipAccuracyOptions& options = {},
                                                const Progress& progress = {});

}  // namespace palpate

// Rigid registration of a frame to a key frame: how far the contact moved and rotated, and how its
// load changed. The slip method `register` and the slip hypotheses use it.
//
//   F(p) ~ gain K(R(-angle)(p - c - d) + c),   c the centroid of the key, d = (dx, dy)
//
// The motion is found by Gauss-Newton least squares from a start value, over the taxels whose
// source position is inside the matrix. A taxel that reads 0 is only known to be below the
// threshold, a saturated one to be at least at saturation; masked taxels are ignored. Weights: 1 /
// (noise^2 + (relative error x model)^2 + variance of the key frame).
#pragma once

#include <limits>

#include <palpate/model/matrix_layout.h>
#include <palpate/slip/key_frame.h>

namespace palpate {

struct RigidMotion {
  // Translation of the key's centroid [taxels].
  double dx = 0.0;
  double dy = 0.0;
  double angleDeg = 0.0;
  double gain = 1.0;
};

struct RegistrationOptions {
  // Largest number of iterations, 1..50.
  int maxIterations = 6;
  // The iteration ends when a pass moves the contact by less than this [taxels]; the rotation
  // counts as motion of the contact's edge.
  double convergedTaxels = 2e-4;
  double noiseCounts = 4.0;  // > 0
  // Relative error of the model, >= 0.
  double relativeError = 0.01;
  // A taxel at or above this value is saturated [counts].
  double saturationCounts = std::numeric_limits<double>::infinity();
  // Prior standard deviation of the rotation from the start value [deg], > 0.
  double anglePriorDeg = 6.0;
  // The rotation is held at its start value if KeyFrame::rotationSensitivity() is below this,
  // 0..0.5.
  double minRotationSensitivity = 0.06;
  // Largest standard deviation [taxels], > 0, up to which a direction of motion counts as
  // observable. Along a less observable direction (a bar along its own axis) the motion is held at
  // its start value.
  double maxDirectionSdTaxels = 0.15;
  // Prior standard deviation of ln gain from the start value, > 0.
  double gainPrior = 0.7;
  // Fraction of the key's load that must be inside the matrix after the motion, 0..1.
  double minOverlap = 0.25;

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// Directions along which the motion cannot be estimated from this contact (degenerate directions;
// Zhang, Kaess, Singh 2016).
struct DegenerateDirections {
  // 0: the motion is fully observable, 1: not along (x, y), 2: not at all.
  int count = 0;
  double x = 0.0;  // unit vector
  double y = 0.0;
};

struct RegistrationResult {
  RigidMotion motion;
  // Weighted squared residual per taxel used; about 1 when the model holds.
  double chi2 = 0.0;
  // Fraction of the key's load that is inside the matrix after the motion, 0..1.
  double overlap = 0.0;
  // Number of taxels used.
  int taxels = 0;
  // Also false when there is no key, no active taxel, or too little overlap.
  bool converged = false;
  // Standard deviations from the weights, valid if the model is correct [taxels, deg]; large for
  // shapes that do not determine the motion.
  double sdX = 0.0;
  double sdY = 0.0;
  double sdAngleDeg = 0.0;
  // Directions along which the motion was held at its start value.
  DegenerateDirections degenerate;
};

// `frame` is an unsmoothed frame of the key's matrix. It is smoothed as the key was, into `scratch`
// (rows x columns values; allocated by the caller, may be null when the key's blur is 0). Allocates
// nothing. If the registration doesn't converge, the motion is the last one tried, or the start
// value when none could be tried. Throws std::invalid_argument when the frame has another size.
RegistrationResult registerFrame(const KeyFrame& key,
                                 const ConstMatrixMap& frame,
                                 const RigidMotion& start,
                                 const RegistrationOptions& options,
                                 float* scratch);

// A key frame together with its registration options and scratch buffer, for a caller that keeps
// one key frame per matrix.
class RigidRegistration {
 public:
  // Throws std::invalid_argument.
  explicit RigidRegistration(const MatrixLayout& layout,
                             const RegistrationOptions& options = {},
                             const KeyFrameOptions& keyOptions = {});

  // As KeyFrame::set().
  bool setKey(const ConstMatrixMap& frame) { return key_.set(frame); }
  void clear() noexcept { key_.clear(); }
  bool hasKey() const noexcept { return !key_.empty(); }
  const KeyFrame& key() const noexcept { return key_; }
  RegistrationResult estimate(const ConstMatrixMap& current, const RigidMotion& start = {}) {
    return registerFrame(key_, current, start, options_, scratch_.data());
  }

 private:
  KeyFrame key_;
  RegistrationOptions options_;
  std::vector<float> scratch_;
};

}  // namespace palpate

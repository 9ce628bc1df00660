// Registers a frame to a key frame: how far the contact moved and turned, and how its load changed.
//
//   F(p) ~ gain K(R(-angle)(p - c - d) + c),   c the centroid of the key, d = (dx, dy)
//
// Gauss-Newton least squares from a start value, over the taxels whose source position lies inside
// the matrix. A taxel that reads 0 is only known to be below the threshold, a saturated one to be
// at least at saturation; masked taxels are ignored. Weights: 1 / (noise^2 + (relative error x
// model)^2 + variance of the key frame).
// x = column (right), y = row (down), in taxels; angles from +x towards +y [deg].
#pragma once

#include <palpate/model/hand_description.h>
#include <palpate/slip/key_frame.h>

namespace palpate {

struct RigidMotion {
  double dx = 0.0;  // of the key's centroid [taxels]
  double dy = 0.0;
  double angleDeg = 0.0;
  double gain = 1.0;
};

struct RegistrationOptions {
  int maxIterations = 6;  // at most, 1..50
  double convergedTaxels =
      2e-4;                     // ends when a pass moves less, also the angle at the contact's edge
  double noiseCounts = 4.0;     // > 0
  double relativeError = 0.01;  // of the model, >= 0
  double saturationCounts = static_cast<double>(kSdh2SaturationCounts);  // at or above: saturated
  // Prior standard deviation of the rotation from the start value [deg], > 0.
  double anglePriorDeg = 6.0;
  // KeyFrame::turning() below which the angle is held, 0..0.5
  double minRotationSensitivity = 0.06;
  // Largest standard deviation [taxels], > 0, up to which a direction of motion counts as
  // observable. Along a less observable direction (a bar along its own axis) the motion is held at
  // its start value.
  double maxDirectionSdTaxels = 0.15;
  double gainPrior = 0.7;    // sd of ln gain from the start, > 0
  double minOverlap = 0.25;  // of the key's load that must lie inside, 0..1

  void validate() const;  // throws std::invalid_argument naming the field
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
  double chi2 = 0.0;       // weighted squares per taxel counted; about 1 when the model holds
  double overlap = 0.0;    // part of the key's load whose place lies inside of the matrix, 0..1
  int taxels = 0;          // counted
  bool converged = false;  // false also: no key, nothing active, too little overlap
  // Standard deviations from the weights, valid if the model is correct [taxels, deg]; large for
  // shapes that do not determine the motion.
  double sdX = 0.0;
  double sdY = 0.0;
  double sdAngleDeg = 0.0;
  DegenerateDirections degenerate;  // held at the start along these
};

// `frame`: of the key's matrix, as it came: it is smoothed as the key was, into `scratch` (rows x
// columns; allocated by the caller, may be null when the key's blur is 0). Allocates nothing. Where
// it doesn't converge the motion is the last one tried, or the start when nothing could be tried.
// Throws std::invalid_argument when the size is another one.
RegistrationResult registerFrame(const KeyFrame& key,
                                 const ConstMatrixMap& frame,
                                 const RigidMotion& start,
                                 const RegistrationOptions& options,
                                 float* scratch);

// A key frame with its options and scratch: the same for whoever keeps a key per matrix.
class RigidRegistration {
 public:
  // Throws std::invalid_argument.
  explicit RigidRegistration(const MatrixLayout& layout,
                             const RegistrationOptions& options = {},
                             const KeyFrameOptions& keyOptions = {});

  bool setKey(const ConstMatrixMap& frame) { return key_.set(frame); }  // as KeyFrame::set
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

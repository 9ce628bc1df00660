// Compares two hypotheses about two frames of one contact: the contact moved (rigid motion), or it
// stayed and its load was redistributed. Comparison of non-nested hypotheses by their residuals
// (Cox 1961).
//
//   still:  F(p) ~ (gain + alongX (x - cx) + alongY (y - cy)) K(p)   a field of load over what
//           doesn't move
//   moved:  F(p) ~ gain K(R(-angle)(p - c - d) + c)                  rigid_registration.h
//
// Both hypotheses use the same weights and the same rule for a taxel that reads 0: its value is
// only known to be below the threshold (left-censored). This censoring at the edge of the contact
// is what distinguishes the hypotheses reliably. Residuals are weighted squares per active taxel: 0
// for a perfect fit, about 1 if the hypothesis is true. The load field is linear, because an
// exponential field could imitate a motion.
//
//   P(moved) = 1 / (1 + ((moved + 1) / (still + 1))^p)
//   p = sharpness / (1 + min(still, moved) / misfit)
//
// If neither hypothesis fits, the exponent p decreases and the score approaches 0.5. P is a score,
// not a calibrated probability.
// x = column (right), y = row (down), in taxels; angles from +x towards +y [deg].
#pragma once

#include <span>

#include <palpate/slip/rigid_registration.h>

namespace palpate {

struct SlipHypothesisOptions {
  // Both hypotheses use this noise and relative error. They are larger than those of the sensor,
  // because real contacts follow neither hypothesis exactly.
  RegistrationOptions registration = {
      .maxIterations = 7, .noiseCounts = 8.0, .relativeError = 0.03};
  double sharpness = 3.0;  // > 0
  double misfit = 10.0;    // > 0

  void validate() const;  // throws std::invalid_argument naming the field
};

struct LoadField {
  double gain = 1.0;
  double alongX = 0.0;  // [1 / taxel]
  double alongY = 0.0;
};

struct LoadFieldResult {
  LoadField field;
  double residual = 0.0;  // weighted squares per active taxel
  int taxels = 0;         // active in the key or in the frame; 0: nothing was fitted
};

// Two passes of linear least squares. Throws std::invalid_argument when the frame hasn't the key's
// size.
LoadFieldResult fitLoadField(const KeyFrame& key,
                             const ConstMatrixMap& frame,
                             const RegistrationOptions& options);

struct SlipHypothesisResult {
  // False if one of the hypotheses could not be fitted; the other fields are then undefined.
  bool computed = false;
  // Estimated motion under the hypothesis that the contact moved.
  RigidMotion motion;
  // Estimated load field under the hypothesis that the contact did not move.
  LoadField field;
  double loadShiftResidual = 0.0;
  double motionResidual = 0.0;
  double pMoved = 0.5;
  double overlap = 0.0;     // of the key's load, inside of the matrix
  double sdAngleDeg = 0.0;  // of motion.angleDeg, widened by the residual
};

// P(moved) of two residuals.
double motionScore(double loadShiftResidual,
                   double motionResidual,
                   const SlipHypothesisOptions& options);

// Fits the motion from each start and keeps the one with the smallest residual. The key frame must
// not be blurred (KeyFrameOptions);
// throws std::invalid_argument (size, blur).
SlipHypothesisResult compareSlipHypotheses(const KeyFrame& key,
                                           const ConstMatrixMap& frame,
                                           std::span<const RigidMotion> starts,
                                           const SlipHypothesisOptions& options);

// Ratio, per axis, of the standard deviation of the motion with a free load field to that with only
// a free gain, to first order, from one key frame: the square root of the variance inflation factor
// (Belsley, Kuh, Welsch 1980). Contacts with edges have 1.5 to 4. A Gaussian contact has no finite
// value in theory (a shifted Gaussian is the Gaussian times an exponential); estimates from noisy
// taxels are 5 to 15. Above kMaxMotionSdInflation a load shift and a small motion along this axis
// cannot be distinguished.
struct MotionSdInflation {
  double x = 1.0;
  double y = 1.0;
};
inline constexpr double kMaxMotionSdInflation = 5.0;
inline constexpr double kUnboundedMotionSdInflation = 1e6;  // also of an empty key
MotionSdInflation motionSdInflation(const KeyFrame& key, const RegistrationOptions& options);

}  // namespace palpate

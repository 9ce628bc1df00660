// Compares two hypotheses about two frames of one contact: the contact moved (rigid motion), or it
// stayed and its load was redistributed. Comparison of non-nested hypotheses by their residuals
// (Cox 1961). SlipWindows and SlipDetector use it.
//
//   still:  F(p) ~ (gain + alongX (x - cx) + alongY (y - cy)) K(p)   a load field over a contact
//           that doesn't move
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
  // Exponent of P(moved) when a hypothesis fits perfectly, > 0.
  double sharpness = 3.0;
  // Residual at which the exponent is halved, > 0.
  double misfit = 10.0;

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

struct LoadField {
  double gain = 1.0;
  double alongX = 0.0;  // [1 / taxel]
  double alongY = 0.0;
};

struct LoadFieldResult {
  LoadField field;
  // Weighted squared residual per active taxel.
  double residual = 0.0;
  // Number of taxels that are active in the key or in the frame; 0: nothing was fitted.
  int taxels = 0;
};

// Fits the load field by two passes of linear least squares. Throws std::invalid_argument when the
// frame has another size than the key.
LoadFieldResult fitLoadField(const KeyFrame& key,
                             const ConstMatrixMap& frame,
                             const RegistrationOptions& options);

struct SlipHypothesisResult {
  // False if one of the hypotheses could not be fitted. Only loadShiftResidual is then defined: 0
  // if the load field could not be fitted either.
  bool computed = false;
  // Estimated motion under the hypothesis that the contact moved.
  RigidMotion motion;
  // Estimated load field under the hypothesis that the contact did not move.
  LoadField field;
  double loadShiftResidual = 0.0;
  double motionResidual = 0.0;
  double pMoved = 0.5;
  // Fraction of the load of the key that is inside the matrix after the motion.
  double overlap = 0.0;
  // Standard deviation of motion.angleDeg [deg], increased according to the residual.
  double sdAngleDeg = 0.0;
};

// Returns P(moved) for the residuals of the two hypotheses.
double motionScore(double loadShiftResidual,
                   double motionResidual,
                   const SlipHypothesisOptions& options);

// Fits both hypotheses to a frame; the motion is fitted from each start, and the fit with the
// smallest residual is kept. The key frame must not be blurred (KeyFrameOptions). Throws
// std::invalid_argument (size, blur).
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
// Largest value that is returned; also the value of an empty key.
inline constexpr double kUnboundedMotionSdInflation = 1e6;
MotionSdInflation motionSdInflation(const KeyFrame& key, const RegistrationOptions& options);

}  // namespace palpate

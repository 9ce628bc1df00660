// Did the contact move, or did only its load shift? Two explanations of the same two frames compete:
//
//   still:  F(p) ~ (gain + alongX (x - cx) + alongY (y - cy)) K(p)   a field of load over what doesn't move
//   moved:  F(p) ~ gain K(R(-angle)(p - c - d) + c)                  rigid_registration.h
//
// with the same weights, and the same rule for a silent taxel, which says no more than "below the threshold" (that the edge of a contact
// is known so badly is what tells the two apart safely). Residuals are weighted squares per active taxel: 0 at best, about
// 1 where the model holds. The field is linear on purpose: an exponential one imitates motion.
//
//   P(moved) = 1 / (1 + ((moved + 1) / (still + 1))^p),   p = sharpness / (1 + min(still, moved) / misfit)
//
// so that the contest counts less where neither holds. P is a score, not a calibrated probability.
// x = column (right), y = row (down), in taxels; angles from +x towards +y [deg].
#pragma once

#include <span>

#include <palpate/slip/rigid_registration.h>

namespace palpate {

struct ContestOptions {
  // Noise and relative error count for both explanations. These are wider than the sensor's: real contacts do neither exactly.
  RegistrationOptions registration = {.passes = 7, .noiseCounts = 8.0, .relativeError = 0.03};
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

// Two passes of linear least squares. Throws std::invalid_argument when the frame hasn't the key's size.
LoadFieldResult fitLoadField(const KeyFrame& key,
                             const ConstMatrixMap& frame,
                             const RegistrationOptions& options);

struct ContestResult {
  bool computed = false;  // false: an explanation could not be fitted, the rest means nothing
  RigidMotion motion;     // were it moved
  LoadField field;        // were it still
  double stillResidual = 0.0;
  double movedResidual = 0.0;
  double pMoved = 0.5;
  double overlap = 0.0;     // of the key's load, inside of the matrix
  double sdAngleDeg = 0.0;  // of motion.angleDeg, widened by the residual
};

// P(moved) of two residuals.
double probabilityMoved(double stillResidual, double movedResidual, const ContestOptions& options);

// The motion is looked for from each start; the best one counts. The key must not be blurred (KeyFrameOptions);
// throws std::invalid_argument (size, blur).
ContestResult contest(const KeyFrame& key,
                      const ConstMatrixMap& frame,
                      std::span<const RigidMotion> starts,
                      const ContestOptions& options);

// How much worse motion is known when the load may tilt: sd(d | field free) / sd(d | only a gain free), per axis, to
// first order, from one key frame. 1.5 to 4 for shapes with edges. In theory it has no bound for a Gaussian (a Gaussian moved IS a
// Gaussian times an exponential); estimated from noisy taxels it comes out as 5 to 15. Above kShapeCannotTell the
// shape can't tell a shift of load from a small motion along that axis.
struct ShapeCondition {
  double x = 1.0;
  double y = 1.0;
};
inline constexpr double kShapeCannotTell = 5.0;
inline constexpr double kWorstCondition = 1e6;  // also of an empty key
ShapeCondition shapeCondition(const KeyFrame& key, const RegistrationOptions& options);

}  // namespace palpate

// Follows the principal axis of a contact over the frames: its rotation since the previous frame
// and since a reference. SlipTracker uses it for every method.
//
// Angles are measured from +x towards +y (clockwise on the screen) [deg].
#pragma once

#include <palpate/slip/contact_moments.h>
#include <palpate/slip/contact_outline.h>

namespace palpate {

struct RotationOptions {
  // Eccentricity by the study's definition, 0..1.
  double minEccentricity = 0.6;
  double maxRoundness = 0.9;  // 0..1
  // Number of active taxels that a frame needs, >= 1.
  int minTaxels = 3;

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

struct SlipRotation {
  // Whether the shape has a direction in this frame, and a side of the matrix does not hide it.
  bool reliable = false;
  // Whether the frame before had a direction, too: `rotationDeg` is known.
  bool valid = false;
  // Rotation from the previous frame to this one, -90..90 deg.
  double rotationDeg = 0.0;
  // Whether this frame and the reference have a direction.
  bool refValid = false;
  // Rotation since the reference [deg], whole turns counted. It keeps its last value while it is
  // not valid. An axis tells an angle only up to half turns, which are counted from step to step:
  // after a step of more than kMaxAxisStepDeg it is not valid until there is a new reference.
  double refRotationDeg = 0.0;
  PrincipalAxis axis;
  double roundness = 0.0;
};

// Whether the part of a contact that is inside the matrix determines the principal axis of the
// whole contact. A side of the matrix cuts the contact if its line of taxels carries at least half
// of the load of the parallel line with the largest load. The part outside is then unknown: it may
// be missing, or the contact may continue point-symmetrically about the centroid of the load on
// that side, or much farther. The axis is determined if, for every side that cuts the contact, the
// axes of the first two cases differ by at most kMaxCutAxisDeg, the continued contact isn't round
// (eccentricity of the study at least 0.6), and the axis is nearer to the normal of the side than
// to the side itself: a strip along the side may be the end of anything. So it is determined for a
// bar that leaves the matrix lengthwise, and not for half a disc or the last rows of a contact that
// moves out. `moments` are those of `frame`. Values that are not above 0 don't count.
inline constexpr double kMaxCutAxisDeg = 10.0;
bool axisIsDetermined(const ConstMatrixMap& frame, const ContactMoments& moments) noexcept;

// Largest step of the axis that is taken for a rotation [deg]. The axis of a nearly round contact
// jumps by up to 90 deg in either direction, and such steps would add up to turns that never were.
inline constexpr double kMaxAxisStepDeg = 45.0;

class RotationTracker {
 public:
  // Throws std::invalid_argument.
  explicit RotationTracker(const RotationOptions& options = {});

  // Processes the next frame. In a frame without contact nothing is known, and the frame after it
  // has no step; the same holds where the axis is not `determined` (axisIsDetermined()).
  const SlipRotation& update(const ContactMoments& moments,
                             double roundness,
                             bool determined = true) noexcept;
  // Call it when frames are missing before the next frame: the next frame then has no step.
  void skip() noexcept { hasLast_ = false; }
  // Makes the newest frame that has a direction the reference. Returns false if there was none yet;
  // the next one then becomes the reference.
  bool setReference() noexcept;
  void clearReference() noexcept {
    hasReference_ = false;
    wantsReference_ = false;
  }
  bool hasReference() const noexcept { return hasReference_; }
  // Forgets all frames; the first direction becomes the reference again.
  void reset() noexcept;

 private:
  RotationOptions options_;
  SlipRotation state_;
  // Whether the last frame had a direction.
  bool hasLast_ = false;
  // Whether any frame had a direction since the start.
  bool followed_ = false;
  // Unwrapped angle of the last frame that had a direction [deg].
  double angleDeg_ = 0.0;
  // Unwrapped angle of the reference [deg].
  double referenceDeg_ = 0.0;
  bool hasReference_ = false;
  // Whether every step since the reference was at most kMaxAxisStepDeg.
  bool countsTurns_ = true;
  bool wantsReference_ = true;
};

}  // namespace palpate

// Follows the principal axis of a contact over the frames: how far it turned since the last one,
// and since a reference.
//
// A principal axis is ambiguous by 180 deg: the direction closer to the previous one is taken, and
// whole turns are counted. The axis is not tracked if the contact is too round: eccentricity (the
// study's definition) below 0.6 and roundness above 0.9.
// Angles from +x towards +y (clockwise on the screen) [deg].
#pragma once

#include <palpate/slip/contact_outline.h>
#include <palpate/slip/principal_axis.h>

namespace palpate {

struct RotationOptions {
  double minEccentricity = 0.6;  // the study's; 0..1
  double maxRoundness = 0.9;     // 0..1
  int minTaxels = 3;             // a frame needs more than two, 1..

  void validate() const;  // throws std::invalid_argument naming the field
};

struct SlipRotation {
  bool reliable = false;     // the shape has a direction
  bool valid = false;        // so has that of the frame before: `rotationDeg` is known
  double rotationDeg = 0.0;  // from the last frame to this one, -90 .. 90
  bool refValid = false;     // and the reference has one
  // since the reference, whole turns counted; keeps its last value while not valid
  double refRotationDeg = 0.0;
  PrincipalAxis axis;
  double roundness = 0.0;
};

class RotationTracker {
 public:
  // Throws std::invalid_argument.
  explicit RotationTracker(const RotationOptions& options = {});

  // The next frame; of one without contact nothing is known, and the next one has no step.
  const SlipRotation& update(const ContactMoments& moments, double roundness) noexcept;
  // There is no step into the next frame: frames are missing before it.
  void skip() noexcept { hasLast_ = false; }
  // The newest frame that has a direction becomes the reference; false: there was none yet, the
  // next one will be.
  bool setReference() noexcept;
  void clearReference() noexcept {
    hasReference_ = false;
    wantsReference_ = false;
  }
  bool hasReference() const noexcept { return hasReference_; }
  // Everything is forgotten; the first direction becomes the reference again.
  void reset() noexcept;

 private:
  RotationOptions options_;
  SlipRotation state_;
  bool hasLast_ = false;       // the last frame had a direction
  bool followed_ = false;      // there ever was one
  double angleDeg_ = 0.0;      // unwrapped, of the last frame that had one
  double referenceDeg_ = 0.0;  // unwrapped
  bool hasReference_ = false;
  bool wantsReference_ = true;
};

}  // namespace palpate

#include "palpate/slip/rotation_tracker.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {

void RotationOptions::validate() const {
  if (!(minEccentricity >= 0.0 && minEccentricity <= 1.0))
    throw std::invalid_argument("RotationOptions: minEccentricity is " +
                                std::to_string(minEccentricity) + ", not 0..1");
  if (!(maxRoundness >= 0.0 && maxRoundness <= 1.0))
    throw std::invalid_argument("RotationOptions: maxRoundness is " + std::to_string(maxRoundness) +
                                ", not 0..1");
  if (minTaxels < 1)
    throw std::invalid_argument("RotationOptions: minTaxels is " + std::to_string(minTaxels));
}

RotationTracker::RotationTracker(const RotationOptions& options) : options_(options) {
  options_.validate();
}

const SlipRotation& RotationTracker::update(const ContactMoments& moments,
                                            double roundness) noexcept {
  state_.axis = principalAxis(moments);
  state_.roundness = roundness;
  state_.valid = false;
  state_.refValid = false;
  state_.rotationDeg = 0.0;
  const bool round =
      state_.axis.studyEccentricity < options_.minEccentricity && roundness > options_.maxRoundness;
  state_.reliable = moments.active >= options_.minTaxels && state_.axis.lambda1 > 0.0 && !round;
  if (!state_.reliable) {
    hasLast_ = false;
    return state_;
  }
  const double orientation = state_.axis.orientationDeg;
  if (followed_) {
    const double off = orientation - angleDeg_;
    const double step = off - 180.0 * std::round(off / 180.0);
    angleDeg_ += step;
    state_.valid = hasLast_;
    if (hasLast_) state_.rotationDeg = step;
  } else {
    angleDeg_ = orientation;
    followed_ = true;
  }
  hasLast_ = true;
  if (wantsReference_) {
    referenceDeg_ = angleDeg_;
    hasReference_ = true;
    wantsReference_ = false;
  }
  state_.refValid = hasReference_;
  if (hasReference_) state_.refRotationDeg = angleDeg_ - referenceDeg_;
  return state_;
}

bool RotationTracker::setReference() noexcept {
  state_.refRotationDeg = 0.0;
  hasReference_ = hasLast_;
  wantsReference_ = !hasLast_;
  if (hasLast_) referenceDeg_ = angleDeg_;
  return hasLast_;
}

void RotationTracker::reset() noexcept {
  const RotationOptions options = options_;
  *this = RotationTracker(options);
}

}  // namespace palpate

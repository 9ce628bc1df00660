// The SDH-2 as the tests of algorithms use it.
#pragma once

#include "palpate/device/sdh2.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/recognition/pinch_hand.h"

namespace palpate {

// Its geometry, with the nominal radius of the fingertips (58 mm) or the effective one (48.4 mm).
inline GeometryDescription sdh2Geometry(BendRadius radius = BendRadius::kNominal) {
  return describeGeometry(sdh2(), radius);
}

inline const PinchHand& sdh2PinchHand() {
  static const std::shared_ptr<const PinchHand> hand = pinchHandOf(sdh2());
  return *hand;
}

}  // namespace palpate

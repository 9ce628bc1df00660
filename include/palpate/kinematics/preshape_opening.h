// How far a preshape may close until an object of a known size is touched.
#pragma once

#include <optional>

#include <palpate/kinematics/hand_geometry.h>
#include <palpate/model/preshape.h>

namespace palpate {

// The close ratio at which a sphere or cylinder of `sizeMm` in the middle between the fingers is
// touched, wherever along the fingers it is: the smallest one that touches the middles of the same
// rows of two pads that face each other (chordDistanceMm()) is no larger, in steps of 0.01 [0..1];
// 0: the open hand is narrower. Empty: the closed hand is still wider, or no pads face each other.
// Throws std::invalid_argument for a preshape with another number of joints, and for a size that is
// negative or not finite.
std::optional<double> touchRatioOf(const HandGeometry& geometry,
                                   const Preshape& preshape,
                                   double sizeMm);

}  // namespace palpate

// How far a preshape may close until an object of a known size is touched.
#pragma once

#include <optional>

#include <palpate/kinematics/hand_geometry.h>
#include <palpate/model/preshape.h>

namespace palpate {

// A larger object isn't asked for [mm].
constexpr double kLargestObjectMm = 1000.0;

// The close ratio at which the distance between two sensor surfaces of different fingers that face
// each other falls to `sizeMm`, in steps of 0.01 [0..1]; 0: the open hand is narrower. An object
// with this width or less between the fingers, in their middle, isn't touched before. Empty: the
// closed hand is still wider, or no surfaces face each other. Throws std::invalid_argument for a
// preshape with another number of joints, and for a size that is negative or not finite.
std::optional<double> touchRatioOf(const HandGeometry& geometry,
                                   const Preshape& preshape,
                                   double sizeMm);

}  // namespace palpate

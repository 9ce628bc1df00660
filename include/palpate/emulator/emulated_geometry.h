// Where the matrices of an emulated hand are in space.
#pragma once

#include <palpate/kinematics/geometry_description.h>
#include <palpate/model/hand_description.h>

namespace palpate {

// Returns the geometry of a hand's description. A hand without surfaces gets a plane: all matrices
// at z = 0 and looking to +z, as its picture draws them (columns to +x, rows to -y), one pitch
// apart, the middle of the picture at the origin. Throws Error when the description is
// inconsistent.
GeometryDescription emulatedGeometry(const HandDescription& hand);

}  // namespace palpate

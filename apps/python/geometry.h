// The geometry of the hand by the name of its fingertip radius, for the Python functions that take
// it.
#pragma once

#include <string>

#include "palpate/kinematics/hand_geometry.h"

namespace palpate::python {

// `fingertip`: "study" or "effective"; raises ValueError for another name.
GeometryDescription geometryNamed(const std::string& fingertip);

}  // namespace palpate::python

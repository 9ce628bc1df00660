// The geometry of the hand by the name of its fingertip radius.
#pragma once

#include <string>

#include "palpate/kinematics/hand_geometry.h"

namespace palpate::python {

// "study", "effective"; raises ValueError.
GeometryDescription geometryNamed(const std::string& fingertip);

}  // namespace palpate::python

// Hands and their geometry, for the Python functions that take them.
#pragma once

#include <string>

#include <pybind11/pybind11.h>

#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/hand_description.h"

namespace palpate::python {

// `given`: a Hand, a name or folder of one, or None for the hand that is meant where none is named.
// Raises TypeError, palpate.Error.
HandDescription handGiven(const pybind11::object& given);

// `fingertip`: "study" or "effective"; raises ValueError for another name, and palpate.Error when
// the description of the hand contains no geometry.
GeometryDescription geometryNamed(const HandDescription& hand, const std::string& fingertip);

}  // namespace palpate::python

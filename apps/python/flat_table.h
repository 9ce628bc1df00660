// Tables of the Python module, dicts of arrays, with one column per number.
#pragma once

#include <string>

#include <pybind11/pybind11.h>

namespace palpate::python {

// Directions and places have three components x, y, z; other values with several components have
// one for each matrix, axis and so on.
bool isVector(const std::string& name);
// The function `flat` of the module. Throws value_error for what is no table.
pybind11::dict flat(const pybind11::dict& table);

}  // namespace palpate::python

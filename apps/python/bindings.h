// The parts of the Python module.
#pragma once

#include <pybind11/pybind11.h>

namespace palpate::python {

void bindProfile(pybind11::module_& module);

}  // namespace palpate::python

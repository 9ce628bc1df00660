// Filters that Python functions take as *specs.
#pragma once

#include <pybind11/pybind11.h>

#include "palpate/filter/recipe.h"

namespace palpate::python {

// Each a text such as "median:size=3", or a list of texts. Raises TypeError, ValueError.
Recipe recipeOf(const pybind11::args& specs);

}  // namespace palpate::python

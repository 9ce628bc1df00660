// Recordings and tables as pandas and xarray have them, where these packages are installed.
#pragma once

#include <cstdint>
#include <optional>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "palpate/model/profile.h"

namespace palpate::python {

// Methods of Profile. Throw import_error where the package is missing.
pybind11::object profileToPandas(const pybind11::object& profile);
pybind11::object profileToXarray(const pybind11::object& profile,
                                 std::optional<std::int64_t> matrix);

}  // namespace palpate::python

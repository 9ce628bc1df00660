// Profiles as bytes, for pickle and with it for other processes (multiprocessing, joblib).
#pragma once

#include <pybind11/pybind11.h>

#include "palpate/model/profile.h"

namespace palpate::python {

// What pickle keeps: a native recording of the whole profile, and what says where it came from.
pybind11::tuple pickledProfile(const Profile& profile);
// The profile again, in memory. Throws value_error for what pickledProfile() has not made.
Profile unpickledProfile(const pybind11::tuple& state);

}  // namespace palpate::python

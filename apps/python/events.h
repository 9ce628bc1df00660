// Converts events of a recording to Python dicts and back. A dict has t_us, t1_us, kind, matrix,
// text, json.
#pragma once

#include <vector>

#include <pybind11/pybind11.h>

#include "palpate/model/event.h"

namespace palpate::python {

pybind11::list toPython(const std::vector<Event>& events);
// From a list of such dicts; t_us and kind are required. Raises ValueError.
std::vector<Event> eventsFrom(const pybind11::object& events);

}  // namespace palpate::python

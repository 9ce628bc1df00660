// Events of a recording as Python has them: a dict t_us, t1_us, kind, matrix, text, json.
#pragma once

#include <vector>

#include <pybind11/pybind11.h>

#include "palpate/recording/recording_event.h"

namespace palpate::python {

pybind11::list toPython(const std::vector<RecordingEvent>& events);
// Of a list of such dicts: t_us and kind must be there. Raises ValueError.
std::vector<RecordingEvent> eventsFrom(const pybind11::object& events);

}  // namespace palpate::python

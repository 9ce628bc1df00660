// A number that may be missing, in JSON. Private to this module.
#pragma once

#include <optional>

#include "palpate/core/json.h"

namespace palpate {

inline Json orNull(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

}  // namespace palpate

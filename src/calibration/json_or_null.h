// Converts a number that may be missing to JSON.
#pragma once

#include <optional>

#include "palpate/core/json.h"

namespace palpate {

inline Json orNull(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

}  // namespace palpate

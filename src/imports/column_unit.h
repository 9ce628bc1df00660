// Units of columns: as headers write them, and how values convert.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace palpate {

// The unit in the name of a column: "kPa" of "left [kPa]" and "left (kPa)", "deg" of "axis0_deg",
// "ms" of "time_ms"; empty where there is none.
std::string unitInName(std::string_view name);

// The name without what unitInName() found: "left", "axis0", "time".
std::string_view nameWithoutUnit(std::string_view name);

// Whether a text is a unit that is known here, or the name of raw values ("raw", "adc", "lsb").
bool isKnownUnit(std::string_view text);

// value * scale + offset.
struct LinearConversion {
  double scale = 1.0;
  double offset = 0.0;
};
// Converts values of one unit to another one of the same quantity (angle, length, temperature,
// pressure, force); nothing where no conversion is known.
std::optional<LinearConversion> conversionBetween(std::string_view from, std::string_view to);

}  // namespace palpate

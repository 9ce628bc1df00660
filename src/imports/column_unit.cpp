#include "imports/column_unit.h"

#include <array>

#include "palpate/imports/import_time.h"

#include "imports/cell_text.h"

namespace palpate {
namespace {

enum class Quantity {
  kCounts,
  kAngle,
  kLength,
  kTemperature,
  kPressure,
  kForce,
  kVoltage,
  kFraction
};

// A unit and what its values have to be multiplied with, and then raised by, to be those of the
// first unit of the same quantity.
struct KnownUnit {
  std::string_view name;  // in small letters
  Quantity quantity;
  double scale = 1.0;
  double offset = 0.0;
};

constexpr double kDegPerRad = 57.295779513082320877;
constexpr std::array<KnownUnit, 50> kKnownUnits = {{
    {"counts", Quantity::kCounts},
    {"count", Quantity::kCounts},
    {"raw", Quantity::kCounts},
    {"adc", Quantity::kCounts},
    {"lsb", Quantity::kCounts},
    {"digits", Quantity::kCounts},
    {"deg", Quantity::kAngle},
    {"degree", Quantity::kAngle},
    {"degrees", Quantity::kAngle},
    {"\xC2\xB0", Quantity::kAngle},
    {"rad", Quantity::kAngle, kDegPerRad},
    {"radian", Quantity::kAngle, kDegPerRad},
    {"radians", Quantity::kAngle, kDegPerRad},
    {"mrad", Quantity::kAngle, kDegPerRad / 1000.0},
    {"rev", Quantity::kAngle, 360.0},
    {"mm", Quantity::kLength},
    {"cm", Quantity::kLength, 10.0},
    {"m", Quantity::kLength, 1000.0},
    {"um", Quantity::kLength, 0.001},
    {"in", Quantity::kLength, 25.4},
    {"degc", Quantity::kTemperature},
    {"celsius", Quantity::kTemperature},
    {"\xC2\xB0"
     "c",
     Quantity::kTemperature},
    {"c", Quantity::kTemperature},
    {"k", Quantity::kTemperature, 1.0, -273.15},
    {"kelvin", Quantity::kTemperature, 1.0, -273.15},
    {"degf", Quantity::kTemperature, 5.0 / 9.0, -160.0 / 9.0},
    {"\xC2\xB0"
     "f",
     Quantity::kTemperature,
     5.0 / 9.0,
     -160.0 / 9.0},
    {"fahrenheit", Quantity::kTemperature, 5.0 / 9.0, -160.0 / 9.0},
    {"kpa", Quantity::kPressure},
    {"pa", Quantity::kPressure, 0.001},
    {"hpa", Quantity::kPressure, 0.1},
    {"mpa", Quantity::kPressure, 1000.0},
    {"bar", Quantity::kPressure, 100.0},
    {"mbar", Quantity::kPressure, 0.1},
    {"psi", Quantity::kPressure, 6.894757293168361},
    {"n/mm2", Quantity::kPressure, 1000.0},
    {"n/mm^2", Quantity::kPressure, 1000.0},
    {"n/cm2", Quantity::kPressure, 10.0},
    {"n/cm^2", Quantity::kPressure, 10.0},
    {"n", Quantity::kForce},
    {"mn", Quantity::kForce, 0.001},
    {"kn", Quantity::kForce, 1000.0},
    {"gf", Quantity::kForce, 0.00980665},
    {"kgf", Quantity::kForce, 9.80665},
    {"lbf", Quantity::kForce, 4.4482216152605},
    {"v", Quantity::kVoltage},
    {"mv", Quantity::kVoltage, 0.001},
    {"1", Quantity::kFraction},
    {"%", Quantity::kFraction, 0.01},
}};

const KnownUnit* knownUnit(std::string_view name) {
  const std::string small = smallLetters(trimmed(name));
  for (const KnownUnit& unit : kKnownUnits)
    if (unit.name == small) return &unit;
  return nullptr;
}

// Where the name ends and the unit that follows.
struct SplitName {
  std::size_t nameEnd = 0;
  std::string unit;
};

// Whether an ending such as "_deg" is taken for a unit: single letters and symbols are parts of
// names ("joint_m", "taxel_1").
bool isUnitEnding(std::string_view text) {
  const KnownUnit* unit = knownUnit(text);
  if (text == "s") return true;
  if (unit && text.size() >= 2) return unit->quantity != Quantity::kCounts || text == "counts";
  const auto time = timeUnitNamed(text);  // "_min" and "_h" are more often other words
  return !unit && time && *time <= TimeUnit::kNanoseconds;
}

SplitName splitName(std::string_view name) {
  if (name.size() > 2) {
    const char last = name.back();
    const char first = last == ']' ? '[' : last == ')' ? '(' : '\0';
    const auto begin = first != '\0' ? name.rfind(first) : std::string_view::npos;
    if (begin != std::string_view::npos && begin > 0) {
      const std::string_view inside = trimmed(name.substr(begin + 1, name.size() - begin - 2));
      if (!inside.empty() && inside.find_first_of("0123456789") != 0)
        return {begin, std::string(inside)};
    }
  }
  const auto underscore = name.rfind('_');
  if (underscore == std::string_view::npos || underscore == 0) return {name.size(), {}};
  const std::string_view ending = name.substr(underscore + 1);
  if (!isUnitEnding(smallLetters(ending))) return {name.size(), {}};
  return {underscore, std::string(ending)};
}

}  // namespace

std::string_view nameWithoutUnit(std::string_view name) {
  return trimmed(name.substr(0, splitName(name).nameEnd));
}

std::string unitInName(std::string_view name) { return splitName(name).unit; }

bool isKnownUnit(std::string_view text) {
  return knownUnit(text) != nullptr || timeUnitNamed(trimmed(text)).has_value();
}

std::optional<LinearConversion> conversionBetween(std::string_view from, std::string_view to) {
  const KnownUnit* source = knownUnit(from);
  const KnownUnit* target = knownUnit(to);
  if (!source || !target) {
    if (smallLetters(trimmed(from)) == smallLetters(trimmed(to))) return LinearConversion{};
    return std::nullopt;
  }
  if (source->quantity != target->quantity) return std::nullopt;
  return LinearConversion{source->scale / target->scale,
                          (source->offset - target->offset) / target->scale};
}

}  // namespace palpate

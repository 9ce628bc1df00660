// Tables with three components per taxel. A row is planned as if each component were a taxel of a
// matrix of three times the width or height, or by the letters x, y, z. Private to this module.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/imports/import_mapping.h"

#include "imports/column_choice.h"

namespace palpate {

struct Planning;

// The layout whose places are the numbers of a row, in their order; that of the hand where no
// matrix has three components. Throws Error: a matrix would be too large.
SensorLayout numbersLayout(const SensorLayout& layout, ComponentOrder order);
// The reading of the hand (SensorLayout::numReadings) at a place of numbersLayout().
std::size_t readingAt(std::size_t place, const SensorLayout& layout, ComponentOrder order);

// Numbers of the columns whose component is known, and their places in numbersLayout().
struct ComponentTaxels {
  std::vector<TableElement> elements;
  Places places;
};
// By the letters in the names (t0_x, by3, m[0][1].z), or by the axis of an array that has the size
// 3; nothing where none or not all of the taxels are found so, and where the order is given. Throws
// FormatError: more than one set of columns fits.
std::optional<ComponentTaxels> taxelsByComponent(Planning& p,
                                                 const std::vector<std::size_t>& columns,
                                                 std::optional<std::size_t> matrix,
                                                 const std::string& what);
// What to do where a table has three numbers per taxel and the hand one; else empty.
std::string componentsAdvice(const Planning& p);

}  // namespace palpate

// The columns that a text of a mapping chooses (see ImportMapping), and groups of columns by name.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/imports/table_source.h"
#include "palpate/model/matrix_layout.h"

namespace palpate {

// One number of a row.
struct TableElement {
  std::size_t column = 0;
  std::size_t within = 0;             // of the numbers of the column's array
  std::vector<std::int64_t> indices;  // in the name, then in the array
};

// Places of the layout (see SensorLayout), one per element.
using Places = std::vector<std::size_t>;

// Columns of the same name but for digits, and of the same number of dimensions.
struct ColumnGroup {
  std::string stem;  // "m#[#][#]"
  std::vector<std::size_t> columns;
  std::vector<TableElement> elements;
  // For each index 'x' or 'y' where a word before it in the names says so (x, c, col, column; y, r,
  // row), else 0.
  std::string letters = {};
};

// What the two indices of a taxel within its matrix are.
enum class IndexOrder { kRowColumn, kColumnRow };
inline IndexOrder opposite(IndexOrder order) {
  return order == IndexOrder::kRowColumn ? IndexOrder::kColumnRow : IndexOrder::kRowColumn;
}

// The groups of the given columns, in the order of their first columns.
std::vector<ColumnGroup> groupColumns(const std::vector<TableColumn>& columns,
                                      const std::vector<std::size_t>& chosen);

// For each element the place in the layout, when the indices of the group are those of the whole
// layout, or of one matrix of it; else nothing.
std::optional<Places> placesOf(const ColumnGroup& group,
                               const SensorLayout& layout,
                               std::optional<std::size_t> matrix,
                               IndexOrder order);

// What the letters of the last two indices that differ say. Nothing without them.
std::optional<IndexOrder> orderByLetters(const ColumnGroup& group);

// How many of the indices differ within the group: 0 or 1 of numbers in a row.
std::size_t numVaryingIndices(const ColumnGroup& group);
// For each element the place where all matrices form one table of rows and columns: one below the
// other, or side by side; nothing when the group is none of all places.
std::optional<Places> placesTiled(const ColumnGroup& group,
                                  const SensorLayout& layout,
                                  IndexOrder order,
                                  bool isSideBySide);
// The group with its last index before the others: where that one is the matrix.
ColumnGroup lastIndexFirst(ColumnGroup group);
// Columns of one name but for a letter and a number at its end, "A1" to "B3", as a group with the
// indices letter (from 0) and number; nothing when that is not what they are called.
std::optional<ColumnGroup> letterGroup(const std::vector<TableColumn>& columns,
                                       const std::vector<std::size_t>& chosen);

// The places of a matrix (or of all) in the order of `count` numbers without indices: all places or
// those that have a taxel; nothing when the number fits neither.
std::optional<Places> placesInOrder(std::size_t count,
                                    const SensorLayout& layout,
                                    std::optional<std::size_t> matrix,
                                    bool columnByColumn);

// A column, or a number of an array: "pad", "#2", "table[0]".
struct ChosenNumber {
  std::size_t column = 0;
  std::optional<std::size_t> within;  // of an array
};
std::optional<ChosenNumber> numberNamed(const std::vector<TableColumn>& columns,
                                        std::string_view name);

// What a text chooses.
struct ChosenElements {
  std::vector<TableElement> elements;
  // Of a pattern with {m}, {y}, {x}, {i}: the letters, in the order of the indices of each element.
  std::string letters;
};
// Throws Error: nothing has such a name; lists what there is.
ChosenElements chooseElements(const std::vector<TableColumn>& columns, const std::string& text);

// The place of each element chosen by a pattern with letters. Throws Error.
Places placesByLetters(const ChosenElements& chosen,
                       const SensorLayout& layout,
                       std::optional<std::size_t> matrix);

}  // namespace palpate

// How the indices of columns, and the names of matrices in theirs, are the places of a hand's
// taxels. Private to this module.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "palpate/model/hand_description.h"
#include "palpate/recording/table_source.h"

#include "recording/import/column_choice.h"
#include "recording/import/column_words.h"

namespace palpate {

// What the indices of a group are.
using OrderOf = std::function<IndexOrder(const ColumnGroup&)>;

// The places of a group's elements; the note says what was not plain.
struct MatrixReading {
  std::vector<std::size_t> places;
  std::string note = {};
};
// One group as the whole hand: by matrix, row and column, or by number; or the matrices are the
// last index; or they form one table, one below the other or side by side. `isReversed`: the axes
// are in reverse order (MATLAB). Throws Error where an array may be either.
std::optional<MatrixReading> readWhole(const ColumnGroup& group,
                                       const SensorLayout& layout,
                                       const std::string& name,
                                       const OrderOf& orderOf,
                                       bool isReversed);
// Columns "A1" to "B3" of one matrix (letterGroup()): the letters are the rows, or the columns,
// whichever fits. Throws Error where both do.
std::optional<MatrixReading> readLetters(const ColumnGroup& lettered, const SensorLayout& layout);

// The names and short names of the matrices, for namedIn().
NameKeys matrixKeys(const HandDescription& hand);
// The columns of a matrix.
struct NamedPart {
  ColumnGroup group;
  bool isOpposite = false;           // only with rows and columns exchanged
  std::vector<std::size_t> inOrder;  // places, where the names tell nothing more
};
// For each matrix the columns that have its name in theirs; none unless all matrices have some that
// fit. Throws Error where more than one could be it.
std::vector<NamedPart> namedParts(const std::vector<TableColumn>& columns,
                                  const std::vector<std::size_t>& chosen,
                                  const HandDescription& hand,
                                  const OrderOf& orderOf);

}  // namespace palpate

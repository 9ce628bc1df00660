// How the indices of columns, and the names of matrices in theirs, are the places of a hand's
// taxels. Private to this module.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "imports/column_words.h"
#include "imports/planning.h"

namespace palpate {

// The places of a group's elements; the note says what was not plain.
struct MatrixReading {
  std::vector<std::size_t> places;
  std::string note = {};
};
// A group as one matrix, or as the whole hand; `isOpposite`: with rows and columns exchanged.
// Throws Error where an array may be read in two ways.
std::optional<MatrixReading> readGroup(const Planning& p,
                                       const ColumnGroup& group,
                                       std::optional<std::size_t> matrix,
                                       bool isOpposite);
// Notes what was not plain, for `what` of the hand: also an order of the taxels that is another one
// than a reader would expect, or a guess.
void noteReading(Planning& p,
                 const std::string& what,
                 const ColumnGroup& group,
                 std::optional<std::size_t> matrix,
                 const MatrixReading& reading,
                 bool isOpposite);
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
std::vector<NamedPart> namedParts(const Planning& p, const std::vector<std::size_t>& chosen);

}  // namespace palpate

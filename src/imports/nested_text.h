// Lines of a text with lists in them: JSON, and what Python prints.
//
//   {"t": 0.01, "data": [1, 2]}    an object per line; the names are t, data[0], data[1]
//   [0.01, (1, 2)]                 a list or a tuple per line: list[0], list[1][0], list[1][1]
//   0.01,"[1, 2]"                  a list in a cell, with commas or blanks; the names of the
//   columns
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace palpate {

// Values of a line in order, and their names.
struct NestedLine {
  std::vector<std::string> names;
  std::vector<std::string_view> values;  // within the line; null is empty
  std::string fault = {};                // why its parts can't be told apart; empty: they can
};

// Adds the values of a list or an object. False: the text is neither, or not well-formed, or holds
// more than kMaxNumbersPerRow values.
bool flattenNested(std::string_view text, const std::string& name, NestedLine& line);

// Puts the names that a line gives its parts in the place of their numbers, so that parts in
// another order are the same parts, and leaves these names out of the values:
//   {"pads": [{"name": "left", "data": [1]}]}        pads.left.data[0]
//   {"tactile_matrix": [{"matrix_id": 1, "x": 2}]}   tactile_matrix[1].x
//   {"name": ["wrist"], "position": [0.5]}           position.wrist
void useGivenNames(NestedLine& line);

// Splits a line into cells; quotes and brackets may hold delimiters.
void splitNestedCells(std::string_view line, char delimiter, std::vector<std::string_view>& cells);

// Whether a cell is a list or an object.
bool isNestedText(std::string_view cell);

}  // namespace palpate

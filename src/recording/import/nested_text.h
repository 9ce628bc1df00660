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
};

// Adds the values of a list or an object. False: the text is neither, or not well-formed, or holds
// more than kMaxNumbersPerRow values.
bool flattenNested(std::string_view text, const std::string& name, NestedLine& line);

// Splits a line into cells; quotes and brackets may hold delimiters.
void splitNestedCells(std::string_view line, char delimiter, std::vector<std::string_view>& cells);

// Whether a cell is a list or an object.
bool isNestedText(std::string_view cell);

}  // namespace palpate

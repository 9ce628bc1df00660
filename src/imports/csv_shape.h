// The shape of a table in a text, detected from its first lines: delimiter, header, units.
//
//   time;m0[0][0];m0[0][1]      separated by comma, semicolon, tab, or blanks and tabs; with or
//   ms;counts;counts            without a line of names and a line of units
//   left:12 right:17            Arduino's serial plotter: names and values in each line
//   10:31:00.123 -> 12,17       a serial monitor's time before each line, also in [brackets]
//   left:1,2,3,4                a line per matrix, also with the number of the frame ("left
//   7:1,2"); right:5,6,7,8               a frame begins with the matrix that came first, as in a
//   stream
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/imports/table_source.h"

#include "imports/nested_text.h"

namespace palpate {

// The columns of a line per matrix.
struct PadColumns {
  std::string name;
  std::size_t first = 0;
  std::size_t count = 0;
};

struct CsvShape {
  char delimiter = ',';
  char decimal = '.';
  bool labelled = false;               // name:value in each cell
  bool nested = false;                 // lists or objects in each line (see nested_text.h)
  std::vector<std::string> cellNames;  // of nested lines: of their cells; none: a line is one list
  std::vector<PadColumns> pads;        // of lines per matrix, in the order of a frame
  bool stamped = false;                // the first column is a serial monitor's time
  std::vector<TableColumn> columns;
  std::uint64_t nameLine = 0;  // 0: none
  std::uint64_t unitLine = 0;
  std::uint64_t linesBefore = 0;  // that come before the rows, with names and units
};

// Detects the shape. `lines` are the first ones of the file. Throws FormatError: no row of numbers,
// decimal commas that were not asked for.
CsvShape detectCsvShape(const std::filesystem::path& path,
                        const std::vector<std::string>& lines,
                        const TableOptions& options);

// Splits a line. Quoted cells may hold delimiters; blanks and tabs of any number are one delimiter.
// The cells are views into `line`.
void splitCells(std::string_view line, char delimiter, std::vector<std::string_view>& cells);

// The values of a nested line and their names; false when it is of another form.
bool splitNested(std::string_view line, const CsvShape& shape, NestedLine& values);

// Takes the time of a serial monitor off the beginning of a line; empty: there is none.
std::string_view takeStamp(std::string_view& line);

// Splits "name:value" or "name=value" cells of a line: names and values are views into `line`.
// False when a cell is of another form. The cells are separated by blanks, tabs, commas or
// semicolons.
bool splitLabelled(std::string_view line,
                   std::vector<std::string_view>& names,
                   std::vector<std::string_view>& values);

// A line of one matrix: "left:1,2,3,4", "left 7:1,2,3,4".
struct PadLine {
  std::string_view name;
  std::optional<std::int64_t> frame;  // its number
  std::string_view values;
};
std::optional<PadLine> splitPadLine(std::string_view line);

// Whether a line holds no row: it is empty or a comment (#, %, //).
bool isCommentLine(std::string_view line);

}  // namespace palpate

// Tables of numbers in files of other programs, read row by row for an import: text (CSV and what
// microcontrollers print), NumPy's .npy and .npz, HDF5, MAT. A row belongs to one instant. A column
// is a number per row (text) or an array per row: of a data set of T x 14 x 6 numbers, a row has 14
// x 6.
//
// A table of any length takes bounded memory: openTable() reads the beginning of a text, or the
// headers of arrays; rows are read one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpate {

// The dates of a column, as its first texts tell.
enum class DateForm {
  kIso,         // 2026-11-22, 22.11.2026, datetime64
  kDayFirst,    // 22/11/2026
  kMonthFirst,  // 11/22/2026
  kEither,      // 11/12/2026
  kClock        // times of day without a date
};

struct TableColumn {
  std::string name;       // as in the file; "column 3" (from 1) where a text has no header
  std::string unit = {};  // as in the file: "kPa"; empty when it is not known
  std::vector<std::size_t> shape = {};        // of the numbers of one row; empty: one number
  std::optional<std::uint64_t> numRows = {};  // known of arrays, not of texts
  // The names of the axes of an array, that of the rows first ("time", "x", "y"); empty: unknown.
  std::vector<std::string> axes = {};
  std::string type = {};  // "int16", "float64", "text", "bool", ..
  // value = number * scale + offset, as the file says (scale_factor, add_offset of netCDF).
  double scale = 1.0;
  double offset = 0.0;
  std::vector<double> missing = {};  // numbers that stand for no value (_FillValue, missing_value)
  std::string example = {};          // the first text of a column that has texts or dates
  bool isNumeric = true;             // false: texts and other things that can't be values
  bool hasDates = false;             // dates or times of day: can only be the time
  DateForm dateForm = DateForm::kIso;  // of such a column
  bool isDayOnly = false;              // dates without a time of day

  // Numbers of one row: the product of the shape.
  std::size_t width() const noexcept;
  // The rows and the shape of an array of these sizes, the rows first; a row of one number has no
  // shape. False: a row has more numbers than 64 bits count.
  bool setArrayShape(std::span<const std::uint64_t> sizes);
};

// What stands where a number should be.
enum class CellState : std::uint8_t {
  kNumber,
  kEmpty,      // nothing: the series has no value in this row
  kNotFinite,  // NaN, infinite, or too large for a float
  kText
};

// The time of a row as the file holds it: a text, a whole number, or a number.
struct TimeCell {
  CellState state = CellState::kEmpty;
  std::string_view text = {};  // of a text; valid until the next row
  std::optional<std::int64_t> whole = {};
  double number = 0.0;
};

struct TableRow {
  std::uint64_t line = 0;  // line of a text, row of arrays; both from 1
  // Whether the row has as many cells as the table has columns. If not, the rest is not valid.
  bool complete = true;
  std::size_t numCells = 0;       // in the row, when it is not complete
  std::string fault;              // why it is not complete: " has 4 cells instead of 5"
  std::vector<double> values;     // of the selected columns, one after the other
  std::vector<CellState> states;  // one per value
  TimeCell time;
};

enum class HeaderChoice { kDetect, kPresent, kAbsent };

// Bytes 0 in a text: what a power cut leaves of data that was not yet on the disk.
struct NulBytes {
  std::uint64_t count = 0;
  std::uint64_t line = 0;  // of the first one
};

// How a text is read; other files need no choices.
struct TableOptions {
  // ',', ';', '\t', or ' ' for blanks and tabs; 0: detected.
  char delimiter = 0;
  char decimal = '.';  // or ','
  HeaderChoice header = HeaderChoice::kDetect;
  bool operator==(const TableOptions&) const = default;
};

class TableSource {
 public:
  virtual ~TableSource() = default;

  virtual const std::filesystem::path& path() const noexcept = 0;
  virtual const std::vector<TableColumn>& columns() const noexcept = 0;
  // What the file is, in words: "CSV, separated by commas, names in line 1".
  virtual std::string form() const = 0;
  // "line" of texts, "row" of arrays.
  virtual const char* rowWord() const noexcept = 0;
  // Starts at the first row with these columns, whose arrays must have the same number of rows.
  // Throws FormatError that names the columns that have not.
  virtual void start(std::span<const std::size_t> columns, std::optional<std::size_t> time) = 0;
  // Reads the next row; false at the end. Throws FileError, FormatError (cut off, damaged).
  virtual bool next(TableRow& row) = 0;
  // How much of the rows has been read, 0..1.
  virtual double fraction() const noexcept = 0;
  // The text that stands at value `index` of the last row.
  virtual std::string textOf(std::size_t index) const = 0;
  // The place of value `index` of the last row, and what stands there: "column 3: \"abc\"" (from
  // 1), "m0[3][2] is nan".
  virtual std::string placeOf(std::size_t index) const = 0;
  // Bytes 0 of a text among the rows read so far; they are left out.
  virtual NulBytes nulBytes() const { return {}; }
  // After the last row: why the end of the file may be missing; empty where nothing says so.
  virtual std::string endNote() const { return {}; }
  // Adds a column that joins two of a text which are parts of one time, and returns its number:
  // whole number * factor + whole number (below the factor); of factor 0 both texts, with a blank
  // between them. Nothing of arrays. Before start().
  virtual std::optional<std::size_t> joinTimes(std::size_t /*first*/,
                                               std::size_t /*second*/,
                                               std::int64_t /*factor*/) {
    return std::nullopt;
  }
  // Makes one row of `count` lines of a text without names, with all their numbers as columns; a
  // number that stands alone before each frame is the first column. Returns in words what a frame
  // is; empty, and nothing is changed, when the lines don't come in such frames. Before start().
  virtual std::string joinLines(std::size_t /*count*/) { return {}; }
  // How rows that are not a line each are put together, for a note; empty: there is nothing to say.
  virtual std::string rowNote() const { return {}; }
  // Whether each column is part of a matrix by its name, as "left[3]": no order says which one.
  virtual bool hasNamedParts() const noexcept { return false; }
  // What a message that no column fits should add: "; its head says 3 rows x 2 columns".
  virtual std::string advice() const { return {}; }
  // What is left out, or may be missing, besides refused rows. Rows missing by their numbers are
  // counted elsewhere up to `mostCounted` at once.
  virtual std::vector<std::string> doubts(double /*mostCounted*/) const { return {}; }
  // The rate that a file gives.
  virtual std::optional<double> rateHz() const { return std::nullopt; }
  // Whether the writer keeps arrays column by column (MATLAB): the axes in the file are reversed.
  virtual bool isColumnMajor() const noexcept { return false; }
  // Reverses the axes of the array of a column, and with them what its rows are. Before start().
  virtual void reverseAxes(std::size_t /*column*/) {}
};

// The longest line of a text [bytes].
constexpr std::size_t kMaxLineBytes = 4u << 20;
// The most numbers that an array, or columns that a text has per row: twice as many as the largest
// hand has taxels.
constexpr std::size_t kMaxNumbersPerRow = 1u << 17;

// Whether a file is HDF5 (MATLAB's files of version 7.3 are, too), as its bytes tell. False for
// what can't be read.
bool isHdf5Table(const std::filesystem::path& path) noexcept;
// Opens a table; the first bytes of the file tell its kind. Throws FileError, FormatError.
std::unique_ptr<TableSource> openTable(const std::filesystem::path& path,
                                       const TableOptions& options = {});

// Name of a delimiter for users: "comma", "semicolon", "tab", "blank"; "detect" of 0.
std::string_view delimiterName(char delimiter);
std::optional<char> delimiterNamed(std::string_view name);

}  // namespace palpate

// Reads a table of text row by row (RFC 4180): cells separated by commas, semicolons or tabs,
// whichever the first line has; a quoted cell may have separators, doubled quotes and line breaks.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace palpate {

// A table that a person made has no more of them: reading a file of something else ends early.
inline constexpr std::size_t kMaximumCells = 1000;
inline constexpr std::size_t kMaximumTableProblems = 100;

// The cell in quotes for a message, without what is behind its first 100 bytes.
std::string quotedCell(std::string_view cell);

class CsvRows {
 public:
  // `csv` must outlive this object. A byte order mark at its begin is passed over.
  explicit CsvRows(std::string_view csv);
  // Takes the next row that is not empty; false at the end. Throws Error if the row has more than
  // kMaximumCells cells.
  bool next(std::vector<std::string>& cells);
  // The line in which the row begins, from 1; 0 before the first one.
  std::size_t line() const noexcept { return line_; }
  // Whether a quote of the row was opened and never closed.
  bool unclosed() const noexcept { return unclosed_; }

 private:
  void readRow(std::vector<std::string>& cells);

  std::string_view rest_;
  char delimiter_ = ',';
  std::size_t nextLine_ = 1;
  std::size_t line_ = 0;
  bool unclosed_ = false;
};

}  // namespace palpate

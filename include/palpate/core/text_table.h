// A table as text: CSV for files, tab-separated for the clipboard. Rows are computed when they are
// written, so that a long table needs no memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>

namespace palpate {

// A table whose rows are computed on demand.
struct TextTable {
  std::vector<std::string> header;  // names with units: "time_ms", "mean [counts]"
  std::size_t numRows = 0;
  // Returns the cells of a row, as many as the header has; an empty cell means "not known". Numbers
  // are formatted by core/number_text.h. May be called in any thread, but only by one at a time.
  std::function<std::vector<std::string>(std::size_t row)> row = {};
};

// Returns one line of CSV with its LF. Cells with commas, quotes or line breaks are quoted (RFC
// 4180); control characters other than tabs and line breaks become \xNN, as a file may have any in
// its name.
std::string csvLine(const std::vector<std::string>& cells);

// Writes header and rows as CSV; a failure leaves no partial file. Throws FileError, Cancelled, and
// std::invalid_argument for a row with another number of cells than the header.
void writeTable(const TextTable& table,
                const std::filesystem::path& path,
                Overwrite overwrite = Overwrite::kRefuse,
                const Progress& progress = {});

// Return the header and the first `maxRows` rows: as CSV, or with tabs, for pasting into
// spreadsheets (tabs and line breaks in cells become blanks).
std::string csvText(const TextTable& table, std::size_t maxRows);
std::string tabbedText(const TextTable& table, std::size_t maxRows);

}  // namespace palpate

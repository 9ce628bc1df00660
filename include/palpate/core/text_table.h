// A table as text: CSV for files, tab-separated for the clipboard. Rows are made when they are
// needed, so that a long table takes no memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>

namespace palpate {

struct TextTable {
  std::vector<std::string> header;  // names with units: "time_ms", "mean [counts]"
  std::size_t numRows = 0;
  // The cells of a row, as many as the header has; an empty one is not known. Numbers by
  // core/number_text.h. May be called in any thread, by one at a time.
  std::function<std::vector<std::string>(std::size_t row)> row = {};
};

// One line of CSV with its LF. Cells with commas, quotes or line breaks are quoted (RFC 4180).
std::string csvLine(const std::vector<std::string>& cells);

// Header and rows as CSV; the file is whole or not there. Throws FileError, Cancelled;
// std::invalid_argument for a row with another number of cells than the header.
void writeTable(const TextTable& table,
                const std::filesystem::path& path,
                Overwrite overwrite = Overwrite::kRefuse,
                const Progress& progress = {});

// Header and the first `maxRows` rows as CSV, or with tabs, as spreadsheets paste it (tabs and
// line breaks in cells become blanks).
std::string csvText(const TextTable& table, std::size_t maxRows);
std::string tabbedText(const TextTable& table, std::size_t maxRows);

}  // namespace palpate

// Result tables (core/result_table.h) as files, in the form of the file's ending;
// docs/notes/exchange_formats.md, "Tables of results", has their layouts.
//
//   .csv, .json  as text (writeTableFile())
//   .npz         an array per column, and `meta`: the head of the JSON form
//   .mat         a structure of columns, and the structure `columns`: name, units, meaning
//   .h5, .hdf5   a group of data sets with the attributes `units` and `meaning`
//   .mcap        a channel of JSON messages, logged at the time of their rows
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <palpate/core/output_file.h>
#include <palpate/core/result_table.h>

namespace palpate {

// All endings, in the order of lists: ".csv", ".json", ..
std::vector<std::string> resultEndings();

struct ResultFileOptions {
  bool unitsRow = false;  // of .csv: a second row with the units
};

// The columns of an .npz or .mat are in memory until the last row: at most this, with 8 bytes per
// number, and 256 and four per byte for a text. Other forms hold some rows.
inline constexpr std::size_t kMaxColumnBytes = std::size_t{1} << 30;

// Writes the rest of a table, whole or not at all. Returns the number of rows. Throws FileError (no
// such ending; what the form can't hold: a table without time in an .mcap, too many values or a
// name too long for an .npz or .mat; HDF5 in a program without it), and what the rows throw.
std::size_t writeResult(ResultTable& table,
                        const std::filesystem::path& path,
                        Overwrite overwrite = Overwrite::kRefuse,
                        const ResultFileOptions& options = {});

}  // namespace palpate

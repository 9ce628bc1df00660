// Imports a table of another program (TableSource) as a recording, by a mapping (ImportMapping):
// a row is a frame, and where the table has them a sample of joint angles, of temperatures, and of
// further series: columns of numbers that are nothing else. Other tables can become series, too
// (SeriesFile). The table is read once, in bounded memory; the recording is whole or not there.
//
// A row is refused, and counted, when it has another number of cells than the table has columns, a
// text where a number is needed, a cell missing among others, or a time that is not later than that
// of the row before. Bytes 0 in a text are left out and counted. Taxels above full scale, below 0
// or NaN are imported and counted; places without a taxel are not looked at. A row without any
// value of a series holds no sample of it: programs that join series of different rates leave such
// cells empty. A further series never refuses a row: what is no number is missing in its sample.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/imports/import_mapping.h>
#include <palpate/imports/import_plan.h>
#include <palpate/imports/table_source.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/series.h>

namespace palpate {

// Rows that were not imported, by what is wrong with them.
struct RefusedRows {
  std::uint64_t wrongCount = 0;  // another number of cells than the table has columns, or names
  std::uint64_t text = 0;        // something else than a number
  std::uint64_t notFinite = 0;   // infinite, larger than a float; NaN of a joint, or of all taxels
  std::uint64_t missing = 0;     // some cells of a series are empty, or the time is
  std::uint64_t notLater = 0;    // the time is not later than that of the row before
  std::string first;             // the first one: "line 12, column 3: \"abc\" is not a number"

  std::uint64_t total() const noexcept {
    return wrongCount + text + notFinite + missing + notLater;
  }
  // "3 rows refused (2 text, 1 time not later)"; empty when none was.
  std::string summary() const;
};

// Values of taxels that are imported though the hand has no such values. NaN is taken as 0.
struct OutsideValues {
  std::uint64_t above = 0;  // the full scale of the matrix
  std::uint64_t below = 0;  // 0, or minus full scale
  std::uint64_t notANumber = 0;
  std::string first;  // the first one: "line 3, pad, row 0, column 1: 1200"
  // Readings of the hand may be below 0; `below` counts those below minus full scale.
  bool isSigned = false;

  std::uint64_t total() const noexcept { return above + below + notANumber; }
  // "3 values outside of the hand's range: 1 above full scale, 2 below 0"; empty when there is
  // none.
  std::string summary() const;
};

// A further series of a recording.
struct ImportedSeries {
  SeriesDescription description;
  std::uint64_t samples = 0;
  double meanRateHz = 0.0;  // (samples - 1) / duration; 0 with fewer than two
  std::uint64_t gaps = 0;   // between samples (GapDetector)
  double longestGapS = 0.0;
  // "series wrench: 6 columns (fx [N], fy [N], ..), 1200 samples, 100 Hz".
  std::string text() const;
};

// Cells of further series that hold neither a number nor NaN: missing values in the recording.
struct NotNumbers {
  std::uint64_t count = 0;
  std::string first;  // "line 12, column 3: \"abc\""
};

struct ImportOptions {
  // Tables of which each becomes a series.
  std::vector<SeriesFile> series = {};
  // The first row that is refused, or has a NaN (but in further series) or a cell of a series that
  // is not a number, ends the import with an error.
  bool strict = false;
  Overwrite overwrite = Overwrite::kRefuse;
};

struct ImportReport {
  std::uint64_t rows = 0;  // of the table
  std::uint64_t frames = 0;
  std::uint64_t angles = 0;        // samples
  std::uint64_t temperatures = 0;  // samples
  std::vector<ImportedSeries> series;
  RefusedRows refused;  // of all tables
  NotNumbers notNumbers;
  OutsideValues outside;
  NulBytes nulBytes;        // left out of a text
  double durationS = 0.0;   // first to last frame [s]
  double meanRateHz = 0.0;  // (frames - 1) / duration; 0 with fewer than two frames
  std::uint64_t gaps = 0;   // between frames (GapDetector)
  double longestGapS = 0.0;
  // Frames of a list of active taxels in which no taxel was active, so that the list does not hold
  // their times.
  std::uint64_t absentFrames = 0;
  // Frames that are missing before others, by the numbers that the file gives them.
  std::uint64_t missingFrames = 0;
  std::string firstMissing;  // "2 frames before line 6"
  // How often a time counter of 32 bits started again at 0, or a time of day passed midnight.
  std::uint64_t counterRestarts = 0;
  std::vector<std::string> notes;  // of the plan, and of what was found in the rows
  // Why values may belong to other taxels (ImportPlan), and what came from other sources.
  std::vector<std::string> doubts;

  // Whether something was left out, or values don't belong to the hand.
  bool isPartial() const noexcept {
    return refused.total() + outside.total() + notNumbers.count + nulBytes.count + missingFrames +
               doubts.size() >
           0;
  }
  // "4096 bytes 0 left out (a power cut?), from line 10"; empty without any.
  std::string nulText() const;
  // One line that says so, with the first of each; empty otherwise.
  std::string lossText() const;
};

// Imports `data` as the recording `out` (.palpate). Throws FileError, FormatError (with the line
// and the column), Cancelled; then `out` is not made or not changed.
ImportReport importRecording(const std::filesystem::path& data,
                             const HandDescription& hand,
                             const ImportMapping& mapping,
                             const std::filesystem::path& out,
                             const ImportOptions& options = {},
                             const Progress& progress = {});

// What an import would do, from the beginning of the table.
struct ImportPreview {
  std::string form;  // "text, separated by commas, names in line 1"
  std::vector<TableColumn> columns;
  // Of the first rows, the first numbers of every column as text.
  std::vector<std::vector<std::string>> rows;
  // Why the mapping can't be used; empty when it can. The fields below are then empty.
  std::string problem;
  std::vector<std::string> choices;  // what becomes what: "matrix 0: m0[0][0] to m0[3][3] .."
  std::string time;                  // "t [ms, by the file]"
  std::vector<std::string> notes;
  // Of the first kPreviewRows rows.
  ImportReport sample;
  double rateHz = 0.0;   // TimingReport::rateHz of its frames
  bool isWhole = false;  // the table has no more rows
};
constexpr std::size_t kPreviewRows = 2000;
constexpr std::size_t kShownPreviewRows = 8;

// Throws FileError, FormatError when the table can't be opened; errors of the mapping are
// reported in `problem`.
ImportPreview previewImport(const std::filesystem::path& data,
                            const HandDescription& hand,
                            const ImportMapping& mapping,
                            const std::vector<SeriesFile>& series = {});

}  // namespace palpate

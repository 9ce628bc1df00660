// Which numbers of a table become which values of a recording: a mapping (ImportMapping), completed
// by what the names and shapes of the columns tell, for one hand and one file.
//
// Columns are grouped by their names without digits and by the dimensions of their arrays:
// "m0[3][2]" of a text and row 3, column 2 of an array m0 of T x 14 x 6 have the same indices
// (0, 3, 2). A group is taken for the taxels when its indices are those of the hand: matrix, row
// and column; matrix and number; or number; from 0 or from 1, for all places or for those that have
// a taxel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/imports/import_mapping.h>
#include <palpate/imports/import_time.h>
#include <palpate/imports/table_source.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/series.h>

namespace palpate {

// Where one number of a row goes.
struct PlannedValue {
  // Place of the layout, axis, temperature sensor or column of a further series; empty: the number
  // is not used.
  std::optional<std::size_t> target;
  double scale = 1.0;  // value = number * scale + offset
  double offset = 0.0;
};

// A number of a frame that is so much further on than that before is another numbering.
constexpr double kMaxMissingFrames = 1000.0;

// When the rows of a series were measured.
struct PlannedTime {
  std::optional<std::size_t> time;  // column; empty: rows at equal intervals
  std::filesystem::path timeFile;   // where that column is; empty: in the file of the values
  // Where the time is a number of the array columns.front(): which one of a row.
  std::optional<std::size_t> timeWithin;
  TimeUnit timeUnit = TimeUnit::kSeconds;
  double timeFactor = 1.0;  // a time is a number x timeFactor of the unit
};

// One time series of the recording.
struct PlannedSeries : PlannedTime {
  enum class Kind { kFrames, kAngles, kTemperatures, kFurther };
  Kind kind = Kind::kFrames;
  SeriesDescription further;  // of kFurther: what it is in the recording
  std::filesystem::path file;
  // A SeriesFile, opened: its rows may be in any order.
  std::shared_ptr<TableSource> table;
  std::optional<double> rateHz;      // of its rows, from the first frame on
  std::vector<std::size_t> columns;  // of the file
  std::vector<PlannedValue> values;  // one per number of these columns in a row
  // Of frames: which one of `values` is their number, which has no target.
  std::optional<std::size_t> number;
  // Which of `values`, which have no target, say what a row is from: the rows of another sensor or
  // topic than the first one are left out.
  std::vector<std::size_t> origins;
  // What was chosen, in words: "matrix 0 \"pad\": m0, kPa to counts, x 0.1".
  std::vector<std::string> description;
};

struct ImportPlan {
  std::vector<PlannedSeries> series;  // frames first
  // The rows are active taxels, as `palpate convert` writes them to .csv:
  // frame,time_ms,matrix,y,x,value,time_us.
  bool isTaxelList = false;
  std::optional<double> rateHz;  // of rows without a time: the mapping's, or that of the file
  std::string timeDescription;
  std::vector<std::string> notes;   // what was not imported, or was guessed
  std::vector<std::string> doubts;  // why values may belong to other taxels, or some are missing
};

// Another table that becomes a series of the recording, with the times of its own rows.
struct SeriesFile {
  std::string name;  // of the series
  std::filesystem::path file;
  std::optional<double> rateHz;  // rows at equal intervals from the first frame on
};

// Throws Error: no column fits, with the shapes that the hand expects and what the file has; a
// column that the mapping names is not there; a unit that can't be converted; a file of `files`
// has no times or no numbers. Columns of numbers that are nothing else become further series,
// unless their first `mostRows` rows hold no number.
ImportPlan planImport(TableSource& source,
                      const HandDescription& hand,
                      const ImportMapping& mapping,
                      const TableOptions& options,
                      std::span<const SeriesFile> files = {},
                      std::uint64_t mostRows = UINT64_MAX);

// The shapes of the hand's matrices, for messages: "1 matrix of 16 x 16, 256 taxels".
std::string shapeText(const SensorLayout& layout);

}  // namespace palpate

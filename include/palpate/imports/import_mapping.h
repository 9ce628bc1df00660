// Which columns of a table are what of a hand: matrices, joint angles, temperatures, time. What is
// left out is found by the names and shapes of the columns. A mapping is kept as JSON:
//
//   {"format": "palpate import mapping 1",
//    "text": {"delimiter": "semicolon", "decimal": ",", "header": "present"},
//    "time": {"column": "t", "unit": "ms", "start": "2026-11-22T10:31:05Z"},      or {"rate_hz":
//    100} "matrices": [{"matrix": 0, "columns": "left[{y}][{x}]", "scale": 0.1, "offset": -2,
//    "unit": "kPa"},
//                 {"matrix": 1, "columns": "#86..#169", "order": "columns"}],
//    "angles": {"columns": "joint*", "unit": "rad", "time": "joint_time"},
//    "temperatures": {"columns": "none"}, "components": "planar"}
//
// Columns are chosen by:
//   NAME                     one column, by its whole name; of HDF5 the path of the data set
//   A..B                     from the column of one name to that of another one
//   #3, #3..#86              by position in the file, from 1
//   left*, *_raw             by pattern: * stands for any characters
//   m{m}[{y}][{x}], t{i}     by pattern with the place of the taxel: matrix, row, column, or its
//                            number in the matrix, row by row; counted from 0 or from 1
//   several of these, with commas between them
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/core/output_file.h>
#include <palpate/imports/table_source.h>

namespace palpate {

// Stands for "no column", where a text chooses columns.
inline constexpr const char* kNoColumns = "none";

struct TimeMapping {
  // Empty: found by name; "none": the rows have no time; two ("Date,Time"): joined. Or a file
  // beside the table, with a time for each of its rows.
  std::string column;
  std::string unit;  // s, ms, us, ns, min, h, iso, dmy, mdy; empty: that of the file, or guessed
                     // from the values
  std::optional<double> rateHz;         // rows at equal intervals; the file's time is not used
  std::optional<std::int64_t> startUs;  // host time of the first row [us since 1970]; empty: as in
                                        // the file, or 0 with a rate
  bool operator==(const TimeMapping&) const = default;
};

// How numbers become values of the hand: number * scale + offset, which is in `unit`, is converted
// to the unit of the hand.
struct ValueMapping {
  double scale = 1.0;
  double offset = 0.0;
  // Empty: that of the file; without one, and after a scale or an offset, that of the hand.
  std::string unit;
  bool operator==(const ValueMapping&) const = default;
};

struct MatrixMapping {
  std::optional<std::size_t> matrix;  // empty: all matrices, one after the other
  std::string columns;
  ValueMapping values;
  // The numbers of a matrix are column after column, instead of row after row.
  bool columnByColumn = false;
  bool operator==(const MatrixMapping&) const = default;
};

// Joint angles in the order of the hand's axes, or temperatures in the order of its sensors.
struct SampleMapping {
  std::string columns;  // empty: found by name; "none": not imported
  ValueMapping values;
  std::string time;  // of arrays that have times of their own; empty: found by name
  bool operator==(const SampleMapping&) const = default;
};

// How the numbers of taxels with three components follow each other.
enum class ComponentOrder {
  kFound,        // by the letters x, y, z of the names or the axes of an array, else interleaved
  kInterleaved,  // x, y, z of the first taxel, then of the next one
  kPlanar        // of each matrix x of all taxels, then y, then z
};

struct ImportMapping {
  TableOptions text;
  TimeMapping time;
  ComponentOrder components = ComponentOrder::kFound;
  std::vector<MatrixMapping> matrices;  // empty: found by name and shape
  SampleMapping angles;
  SampleMapping temperatures;
  bool operator==(const ImportMapping&) const = default;
};

Json mappingJson(const ImportMapping& mapping);
// Throws FormatError that names `source` and the key ("matrices[1].scale is 0: ..").
ImportMapping mappingFromJson(const std::string& text, const std::filesystem::path& source);

// Throw FileError; readMapping() also FormatError.
ImportMapping readMapping(const std::filesystem::path& path);
void writeMapping(const ImportMapping& mapping,
                  const std::filesystem::path& path,
                  Overwrite overwrite = Overwrite::kRefuse);

}  // namespace palpate

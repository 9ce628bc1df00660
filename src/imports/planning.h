// What the parts of planning an import share, and these parts. Private to this module.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/imports/import_plan.h"

#include "imports/column_choice.h"
#include "imports/component_choice.h"
#include "imports/import_texts.h"
#include "imports/time_choice.h"

namespace palpate {

struct Planning {
  // Once, however often there is a reason.
  void note(const std::string& text) {
    if (std::find(plan.notes.begin(), plan.notes.end(), text) == plan.notes.end())
      plan.notes.push_back(text);
  }
  void note(Reason reason, std::initializer_list<std::string> values) {
    note(sentenceOf(reason, values));
  }
  [[noreturn]] void refuse(Reason reason, std::initializer_list<std::string> values) const {
    throw FormatError(source.path(), sentenceOf(reason, values));
  }

  TableSource& source;
  const HandDescription& hand;
  ImportMapping mapping;  // with the rate of the file, if that is all there is
  const std::vector<TableColumn>& columns = source.columns();
  // Of the numbers of a frame (numbersLayout): that of the hand, but with three components.
  SensorLayout layout = numbersLayout(*hand.layout, mapping.components);
  ImportPlan plan = {};
  TimeChoice times{source, mapping, plan};
  bool isReversed = false;                   // the axes of all arrays
  std::set<std::size_t> sampleColumns = {};  // of angles and temperatures
};

// How the numbers of a column become values of the hand, and their unit.
struct AddedValues {
  PlannedValue value;
  std::string unit;
};
// Adds elements, which have the unit of the first one's column, to a series with a target each, in
// the hand's unit. Throws FormatError: the unit can't be converted, an element is used twice.
AddedValues addValues(Planning& p,
                      PlannedSeries& series,
                      const std::string& what,
                      const std::vector<TableElement>& elements,
                      const std::vector<std::size_t>& targets,
                      const ValueMapping& values,
                      const std::string& handUnit);

// The names of a hand's axes, or of its temperature sensors.
std::vector<std::string> namesOf(const HandDescription& hand, PlannedSeries::Kind kind);
const SampleMapping& sampleMapping(const Planning& p, PlannedSeries::Kind kind);

// The series of the joint angles or temperatures, without its time: as the mapping says, or by the
// names of the columns; nothing where they are not there. Throws FormatError.
std::optional<PlannedSeries> chooseSamples(Planning& p, PlannedSeries::Kind kind);

// Adds the columns of numbers that nothing is made of as series with the times of the frames: an
// array is one, columns of one prefix are one, the others are the series "table". Names that
// `files` have are left to them. What holds no number in the first `mostRows` rows stays out.
void chooseFurther(Planning& p, std::span<const SeriesFile> files, std::uint64_t mostRows);

// The column of time_us in a table of samples that `palpate convert` writes beside a .csv
// ("sample,time_ms,fz_N,..,time_us", then perhaps "device_time_us"); empty: another table.
std::optional<std::size_t> exportedTimeOf(const std::vector<TableColumn>& columns);

// The series of another file, and its notes and doubts in `plan`. Throws FormatError, FileError.
PlannedSeries planSeriesFile(const SeriesFile& wanted,
                             const HandDescription& hand,
                             const ImportMapping& mapping,
                             std::uint64_t mostRows,
                             ImportPlan& plan);

// Whether a series of the hand has this name.
inline bool isHandSeries(std::string_view name) {
  return name == "angles" || name == "temperatures";
}
// Whether a column says what a row is from: sensor, topic, device_id.
bool saysOrigin(const TableColumn& column);

// Reverses the axes of all arrays where their last one is the frames: by its name, or since the
// hand fits only then (MATLAB's pad(frames, rows, columns), NumPy's rows x columns x frames).
// Throws FormatError: it may be either.
void findFrameAxis(Planning& p);

// The series of the frames, without its time. Throws FormatError: nothing fits.
PlannedSeries chooseFrames(Planning& p);

}  // namespace palpate

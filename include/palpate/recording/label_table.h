// The labels of a recording as a table: what a person has noted (labels, notes, marks and corrected
// segments) as CSV that a spreadsheet or a script can read and write, and back.
//
// Columns: begin_s, end_s [s from the first frame of the recording], kind ("label", "note", "mark",
// "segment"), text, matrix (index in wire order; empty: none). Times have six decimals, so that the
// events read back are the same to the microsecond. What the table has no column for (the JSON of
// an event) isn't in it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/result_table.h>
#include <palpate/model/event.h>
#include <palpate/model/profile.h>

namespace palpate {

// The kinds that a table of labels has.
bool isTabledLabel(const Event& event);

// The labels among the events as a result table, in order of time. A profile without frames has
// none.
std::unique_ptr<ResultTable> labelRows(std::span<const Event> events, const Profile& profile);

struct LabelTable {
  std::vector<Event> events;  // of the good rows, in order of the lines
  // One line for each bad row: "line 7: begin_s 'abc' is not a number". Lines count from 1.
  std::vector<std::string> problems;
  // Rows of other recordings, by the column file: they are not taken.
  std::size_t numOthers = 0;
  // Reading ended at kMaximumTableProblems (core/csv_rows.h): there are more rows.
  bool more = false;
};

// Largest table that is read [bytes].
inline constexpr std::size_t kMaxLabelTableBytes = 16u << 20;
inline constexpr std::size_t kMaximumLabels = 10'000;

// Reads a table of labels, separated by commas, semicolons or tabs. Columns are found by their
// names in the first line, in any order and case; begin_s and text must be there. Without end_s a
// label is a moment, without kind it is a "label". The matrix is a name or an index. Of a table
// with a column file only the rows of `recording` are taken: those that name this file, or one of
// its name that isn't there. Other columns are passed over. A row is bad when a number is none, it
// ends before it begins, begins or ends outside of the recording, has an unknown kind, no matrix of
// the recording, no text (a segment may have none), bytes that are no UTF-8, or another number of
// cells than the first line. Reading ends at the first row beyond kMaximumLabels, which is a
// problem. Throws Error when the first line has not these columns, a row has more than
// kMaximumCells cells, all rows are of other recordings, the text is UTF-16, or the profile has no
// frames.
LabelTable readLabelTable(std::string_view csv,
                          const Profile& profile,
                          const std::filesystem::path& recording = {});

// The events of `table` that `present` doesn't have yet (the JSON doesn't count): a table that is
// imported twice adds its labels once.
std::vector<Event> newLabels(const LabelTable& table, std::span<const Event> present);

}  // namespace palpate

// A plan of recordings: which objects are recorded, in which runs and how often; which of these
// takes were made; which comes next. It is a table that spreadsheets read and write (CSV with the
// columns object, run, repetitions, notes), and it is kept as JSON with the takes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpate {

// One recording that was made for a row of the plan.
struct PlannedTake {
  std::filesystem::path file = {};  // of its first part
  // What a check found wrong with it, one line; empty: nothing.
  std::string problem = {};
  // It was rejected: it counts no longer, and is to be repeated.
  bool rejected = false;
  // It counts in spite of its problem.
  bool kept = false;
  // It has a problem, and nobody said yet whether it counts.
  bool undecided() const noexcept { return !problem.empty() && !rejected && !kept; }
  bool operator==(const PlannedTake&) const = default;
};

struct PlanRow {
  std::string object = {};  // not empty
  std::string run = {};     // which run; may be empty
  int repetitions = 1;      // 1..RecordingPlan::kMaxRepetitions
  std::string notes = {};
  std::vector<PlannedTake> takes = {};  // in the order in which they were made

  // Number of takes that count, and of those that are to be decided.
  int numDone() const noexcept;
  int numUndecided() const noexcept;
  bool operator==(const PlanRow&) const = default;
};

// The next take.
struct PlanStep {
  std::size_t row = 0;
  int repetition = 1;  // from 1
  bool operator==(const PlanStep&) const = default;
};

class RecordingPlan {
 public:
  static constexpr int kMaxRepetitions = 999;
  static constexpr std::size_t kMaxRows = 10'000;
  static constexpr std::size_t kMaxTextBytes = 1000;  // of each text of a row

  const std::vector<PlanRow>& rows() const noexcept { return rows_; }
  // Appends a row. Throws Error (the row has a problem, see problemOf(); too many rows).
  void addRow(PlanRow row);
  // Replaces object, run, repetitions and notes of a row; its takes stay. Throws std::out_of_range,
  // Error as above.
  void setRow(std::size_t row, const PlanRow& now);
  // Removes a row; the files of its takes stay. Throws std::out_of_range.
  void removeRow(std::size_t row);

  // Takes of the whole plan, and how many of them were made and count: "3 of 12".
  int total() const noexcept;
  int numDone() const noexcept;
  // Takes that are to be decided.
  int numUndecided() const noexcept;
  // The first row, from the top, of which not all takes were made. A take that is to be decided
  // keeps its place until then. Empty: there is none.
  std::optional<PlanStep> next() const noexcept;

  // Adds a take. Throws std::out_of_range.
  void addTake(std::size_t row, PlannedTake take);
  // The take of this file; null: it is in no row.
  const PlannedTake* find(const std::filesystem::path& file) const noexcept;
  // The following return false if the plan has no such take.
  bool setProblem(const std::filesystem::path& file, const std::string& problem);
  bool reject(const std::filesystem::path& file);
  // The take counts in spite of its problem.
  bool keep(const std::filesystem::path& file);
  bool rename(const std::filesystem::path& from, const std::filesystem::path& to);
  // The file was discarded: it is no take any more.
  bool forget(const std::filesystem::path& file);
  // Begins anew: all takes are forgotten, their files stay.
  void forgetTakes() noexcept;

  // The plan with its takes, and back. fromJson() throws Error with one line that names what is
  // wrong.
  std::string json() const;
  static RecordingPlan fromJson(std::string_view text);
  bool operator==(const RecordingPlan&) const = default;

 private:
  PlannedTake* take(const std::filesystem::path& file) noexcept;

  std::vector<PlanRow> rows_;
};

// What is wrong with a row, naming the column ("repetitions must be 1..999"); empty: nothing.
std::string problemOf(const PlanRow& row);

struct PlanTable {
  std::vector<PlanRow> rows;  // the good ones, in order of the lines
  // One line for each bad row: "line 3, repetitions: 'x' is not a whole number". Lines count from
  // 1.
  std::vector<std::string> problems;
  // Reading ended at kMaximumTableProblems (core/csv_rows.h): there are more rows.
  bool more = false;
};

// Largest table that is read [bytes].
inline constexpr std::size_t kMaxPlanTableBytes = 16u << 20;

// Reads a table, separated by commas, semicolons or tabs. Columns are found by their names in the
// first line, in any order; object must be there. Without repetitions a row is one take. Other
// columns are passed over. Reading ends at the first row beyond RecordingPlan::kMaxRows, which is
// a problem. Throws Error when the first line has no column object, or names one twice, or a row
// has more than kMaximumCells cells.
PlanTable readPlanTable(std::string_view csv);
// The plan as CSV: object, run, repetitions, notes, and done (takes that count).
std::string planCsv(const RecordingPlan& plan);

}  // namespace palpate

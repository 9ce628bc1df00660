#include "palpate/capture/recording_plan.h"

#include <algorithm>
#include <array>
#include <utility>

#include "palpate/core/csv_rows.h"
#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/text_table.h"
#include "palpate/core/utf8.h"

namespace palpate {
namespace {

constexpr std::array<std::string_view, 4> kPlanColumns = {"object", "run", "repetitions", "notes"};
constexpr std::int64_t kPlanFormat = 1;

// Index of each of kPlanColumns in the rows.
using PlanColumns = std::array<std::optional<std::size_t>, kPlanColumns.size()>;

std::string_view trimmedCell(std::string_view cell) {
  while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t')) cell.remove_prefix(1);
  while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t')) cell.remove_suffix(1);
  return cell;
}

PlanColumns planColumnsOf(const std::vector<std::string>& names) {
  PlanColumns columns;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t c = 0; c < kPlanColumns.size(); ++c)
      if (trimmedCell(names[i]) == kPlanColumns[c]) {
        if (columns[c])
          throw Error("the first line names the column " + std::string(kPlanColumns[c]) + " twice");
        columns[c] = i;
      }
  if (!columns[0])
    throw Error(
        "the first line must name the column object (and may name run, repetitions, notes)");
  return columns;
}

// Throws Error with the column and what is wrong with it.
PlanRow planRowOf(const std::vector<std::string>& cells,
                  const PlanColumns& columns,
                  std::size_t count) {
  if (cells.size() != count)
    throw Error(": has " + counted(cells.size(), "cell") + ", the first line has " +
                std::to_string(count));
  const auto cell = [&](std::size_t c) {
    return columns[c] ? std::string(trimmedCell(cells[*columns[c]])) : std::string();
  };
  PlanRow row{.object = cell(0), .run = cell(1), .notes = cell(3)};
  if (const std::string text = cell(2); !text.empty()) {
    const auto number = parseInteger(text);
    if (!number) throw Error(", repetitions: " + quotedCell(text) + " is not a whole number");
    // What doesn't fit is out of range in any case.
    row.repetitions =
        static_cast<int>(std::clamp<std::int64_t>(*number, 0, RecordingPlan::kMaxRepetitions + 1));
  }
  if (const std::string problem = problemOf(row); !problem.empty()) throw Error(", " + problem);
  return row;
}

Json takeJson(const PlannedTake& take) {
  return Json::object()
      .set("file", take.file.string())
      .set("problem", take.problem)
      .set("rejected", take.rejected)
      .set("kept", take.kept);
}

// Line ends and tabs are text.
bool isControl(char c) {
  const auto code = static_cast<unsigned char>(c);
  return code == 0x7F || (code < 0x20 && c != '\t' && c != '\n' && c != '\r');
}

}  // namespace

int PlanRow::numDone() const noexcept {
  return static_cast<int>(std::count_if(takes.begin(), takes.end(), [](const PlannedTake& take) {
    return !take.rejected && !take.undecided();
  }));
}

int PlanRow::numUndecided() const noexcept {
  return static_cast<int>(std::count_if(
      takes.begin(), takes.end(), [](const PlannedTake& take) { return take.undecided(); }));
}

std::string problemOf(const PlanRow& row) {
  if (row.object.empty()) return "object: is empty";
  for (const auto& [name, text] : {std::pair("object", &row.object),
                                   std::pair("run", &row.run),
                                   std::pair("notes", &row.notes)}) {
    if (text->size() > RecordingPlan::kMaxTextBytes)
      return std::string(name) + ": is longer than " +
             std::to_string(RecordingPlan::kMaxTextBytes) + " bytes";
    // A plan is kept as JSON, which can't hold other bytes.
    if (!isUtf8(*text)) return std::string(name) + ": is not UTF-8; save the table as UTF-8";
    if (std::any_of(text->begin(), text->end(), isControl))
      return std::string(name) + ": has a control character";
  }
  if (row.repetitions < 1 || row.repetitions > RecordingPlan::kMaxRepetitions)
    return "repetitions: must be 1.." + std::to_string(RecordingPlan::kMaxRepetitions);
  return {};
}

void RecordingPlan::addRow(PlanRow row) {
  if (const std::string problem = problemOf(row); !problem.empty()) throw Error(problem);
  if (rows_.size() >= kMaxRows)
    throw Error("a plan has at most " + std::to_string(kMaxRows) + " rows");
  rows_.push_back(std::move(row));
}

void RecordingPlan::setRow(std::size_t row, const PlanRow& now) {
  PlanRow& changed = rows_.at(row);
  if (const std::string problem = problemOf(now); !problem.empty()) throw Error(problem);
  std::vector<PlannedTake> takes = std::move(changed.takes);
  changed = now;
  changed.takes = std::move(takes);
}

void RecordingPlan::removeRow(std::size_t row) {
  static_cast<void>(rows_.at(row));
  rows_.erase(rows_.begin() + static_cast<std::ptrdiff_t>(row));
}

int RecordingPlan::total() const noexcept {
  int total = 0;
  for (const PlanRow& row : rows_) total += row.repetitions;
  return total;
}

// Extra takes of one row do not count for another.
int RecordingPlan::numDone() const noexcept {
  int done = 0;
  for (const PlanRow& row : rows_) done += std::min(row.numDone(), row.repetitions);
  return done;
}

int RecordingPlan::numUndecided() const noexcept {
  int undecided = 0;
  for (const PlanRow& row : rows_) undecided += row.numUndecided();
  return undecided;
}

std::optional<PlanStep> RecordingPlan::next() const noexcept {
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const int made = rows_[row].numDone() + rows_[row].numUndecided();
    if (made < rows_[row].repetitions) return PlanStep{row, made + 1};
  }
  return std::nullopt;
}

void RecordingPlan::addTake(std::size_t row, PlannedTake take) {
  rows_.at(row).takes.push_back(std::move(take));
}

PlannedTake* RecordingPlan::take(const std::filesystem::path& file) noexcept {
  for (PlanRow& row : rows_)
    for (PlannedTake& take : row.takes)
      if (take.file == file) return &take;
  return nullptr;
}

const PlannedTake* RecordingPlan::find(const std::filesystem::path& file) const noexcept {
  return const_cast<RecordingPlan*>(this)->take(file);
}

bool RecordingPlan::setProblem(const std::filesystem::path& file, const std::string& problem) {
  PlannedTake* const found = take(file);
  if (found) found->problem = problem;
  return found != nullptr;
}

bool RecordingPlan::reject(const std::filesystem::path& file) {
  PlannedTake* const found = take(file);
  if (found) found->rejected = true;
  return found != nullptr;
}

bool RecordingPlan::keep(const std::filesystem::path& file) {
  PlannedTake* const found = take(file);
  if (found) found->kept = true;
  return found != nullptr;
}

bool RecordingPlan::rename(const std::filesystem::path& from, const std::filesystem::path& to) {
  PlannedTake* const found = take(from);
  if (found) found->file = to;
  return found != nullptr;
}

bool RecordingPlan::forget(const std::filesystem::path& file) {
  for (PlanRow& row : rows_)
    if (std::erase_if(row.takes, [&](const PlannedTake& take) { return take.file == file; }) > 0)
      return true;
  return false;
}

void RecordingPlan::forgetTakes() noexcept {
  for (PlanRow& row : rows_) row.takes.clear();
}

std::string RecordingPlan::json() const {
  Json rows = Json::array();
  for (const PlanRow& row : rows_)
    rows.push(Json::object()
                  .set("object", row.object)
                  .set("run", row.run)
                  .set("repetitions", row.repetitions)
                  .set("notes", row.notes)
                  .set("takes", jsonList(row.takes, takeJson)));
  return Json::object().set("plan", kPlanFormat).set("rows", std::move(rows)).text(-1);
}

RecordingPlan RecordingPlan::fromJson(std::string_view text) {
  const Json json = Json::parse(text);
  if (!json.isObject() || !json.contains("plan")) throw Error("is not a plan of recordings");
  if (json.at("plan").asInteger() != kPlanFormat)
    throw Error("is a plan of another version of the program");
  RecordingPlan plan;
  const Json rows = json.at("rows");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Json row = rows.at(i);
    PlanRow read{.object = row.at("object").asString(),
                 .run = row.at("run").asString(),
                 .repetitions = static_cast<int>(std::clamp<std::int64_t>(
                     row.at("repetitions").asInteger(), 0, kMaxRepetitions + 1)),
                 .notes = row.at("notes").asString()};
    const Json takes = row.at("takes");
    for (std::size_t t = 0; t < takes.size(); ++t) {
      const Json take = takes.at(t);
      // Plans of earlier versions don't say whether a take was kept.
      read.takes.push_back({take.at("file").asString(),
                            take.at("problem").asString(),
                            take.at("rejected").asBool(),
                            take.contains("kept") && take.at("kept").asBool()});
    }
    plan.addRow(std::move(read));
  }
  return plan;
}

PlanTable readPlanTable(std::string_view csv) {
  CsvRows lines(csv);
  std::vector<std::string> cells;
  if (!lines.next(cells)) throw Error("the table is empty");
  const PlanColumns columns = planColumnsOf(cells);
  const std::size_t count = cells.size();
  PlanTable table;
  while (lines.next(cells)) {
    const std::string line = "line " + std::to_string(lines.line());
    if (table.problems.size() == kMaximumTableProblems) {
      table.more = true;
      break;
    }
    if (table.rows.size() == RecordingPlan::kMaxRows) {
      table.problems.push_back(line + ": a plan has at most " +
                               std::to_string(RecordingPlan::kMaxRows) + " rows");
      break;
    }
    try {
      if (lines.unclosed()) throw Error(": a quote is never closed");
      table.rows.push_back(planRowOf(cells, columns, count));
    } catch (const Error& error) {
      table.problems.push_back(line + error.what());
    }
  }
  return table;
}

std::string planCsv(const RecordingPlan& plan) {
  std::string csv = csvLine({"object", "run", "repetitions", "notes", "done"});
  for (const PlanRow& row : plan.rows())
    csv += csvLine({row.object,
                    row.run,
                    std::to_string(row.repetitions),
                    row.notes,
                    std::to_string(row.numDone())});
  return csv;
}

}  // namespace palpate
